// SPDX-License-Identifier: Apache-2.0
#include "piola/output/checkpoint.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/domain/error_agreement.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/output/broadcast_reader.hpp"
#include "piola/output/collective_table_writer.hpp"
#include "piola/output/hdf5.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <new>
#include <sstream>

namespace piola {
namespace {

constexpr std::int64_t layout_version = 5;

/// Puts arrays into a group of the file that rank 0 has open; null on other ranks.
class GroupWriter : public StateWriter {
 public:
  GroupWriter(hdf5::Writer* file, std::string group) : file_(file), group_(std::move(group)) {}
  void put(std::string_view name, std::span<double const> values) override {
    rows_.try_on_root([&] {
      std::string const path = path_of(name);
      file_->dataset<double>(path, values);
      file_->attribute(path, "name", name);
    });
  }
  void put_rows(std::string_view name, DistributedRows const& rows, std::span<double const> values) override {
    rows_.put(path_of(name), rows, values, hdf5::Storage::sequence);
    rows_.try_on_root([&] { file_->attribute(path_of(name), "name", name); });
  }
  void end_rows() override { rows_.end(); }

 private:
  /// A name may hold slashes, which HDF5 would take for groups.
  std::string path_of(std::string_view name) const {
    std::string path = fmt::format("{}/{}", group_, name);
    std::replace(path.begin() + static_cast<std::ptrdiff_t>(group_.size()) + 1, path.end(), '/', '.');
    return path;
  }
  hdf5::Writer* file_;
  std::string group_;
  CollectiveTableWriter rows_{file_};
};

void put_all(NamedState const& state, StateWriter& writer) {
  for (auto const& [name, values] : state.arrays()) writer.put(name, values);
}

std::string no_such_name(std::string_view name) {
  return fmt::format("checkpoint: has no '{}' - it was written by another version or formulation; run the case again",
                     name);
}

void demand_size(std::string_view name, std::size_t has, std::size_t needed) {
  if (has == needed) return;
  throw FileError(
      fmt::format("checkpoint: '{}' has {} numbers (this case needs {}) - run the case again", name, has, needed));
}

/// Paths of the data sets of a group, by the names that they were put with.
std::map<std::string, std::string, std::less<>> paths_of(hdf5::Reader const& file, std::string const& group) {
  std::map<std::string, std::string, std::less<>> paths;
  for (std::string const& name : file.names(group)) {
    std::string const path = fmt::format("{}/{}", group, name);
    paths.emplace(file.text(path, "name"), path);
  }
  return paths;
}

NamedState get_state(hdf5::Reader const& file, std::string const& group) {
  NamedState state;
  for (auto const& [name, path] : paths_of(file, group)) state.put(name, file.dataset<double>(path));
  return state;
}

/// Reads the arrays of a group when they are asked for.
class GroupReader : public StateReader {
 public:
  GroupReader(std::shared_ptr<hdf5::Reader const> file, std::string const& group)
      : file_(std::move(file)), paths_(paths_of(*file_, group)) {}
  void get(std::string_view name, std::span<double> values) override {
    auto const kept = file_->dataset<double>(path(name));
    demand_size(name, kept.size(), values.size());
    std::copy(kept.begin(), kept.end(), values.begin());
  }
  std::optional<FileExtent> place(std::string_view name, std::size_t count) override {
    auto const at = file_->place_of_doubles(path(name));
    if (!at) return std::nullopt;
    demand_size(name, file_->shape_of_numbers(path(name)).front(), count);
    return FileExtent{file_->path().string(), *at};
  }

 private:
  std::string const& path(std::string_view name) const {
    auto const found = paths_.find(name);
    if (found == paths_.end()) throw FileError(no_such_name(name));
    return found->second;
  }
  std::shared_ptr<hdf5::Reader const> file_;
  std::map<std::string, std::string, std::less<>> paths_;
};

/// How long runs took: step, seconds of wall time, of these in steps.
struct Duration {
  std::int64_t step;
  double wall, stepping;
};

std::filesystem::path durations_path(std::filesystem::path const& results) {
  return results / "checkpoints" / durations_name;
}

/// Nothing of a file that is not there or not whole: no number of a run depends on it.
std::vector<Duration> read_durations(std::filesystem::path const& results) {
  auto const path = durations_path(results);
  std::istringstream file(FileToRead(path).problem().empty() ? read_text_file(path) : "");
  std::string headline;
  std::getline(file, headline);
  std::vector<Duration> list;
  for (Duration d{}; file >> d.step >> d.wall >> d.stepping && std::isfinite(d.wall + d.stepping);) list.push_back(d);
  return list;
}

/// Adds a line for this checkpoint; those of checkpoints that are gone go, too.
void keep_duration(std::filesystem::path const& results, Checkpoint const& checkpoint) {
  std::string text = "step, wall time [s], of it in steps [s]; of each checkpoint\n";
  auto const add = [&](Duration const& d) { text += fmt::format("{} {} {}\n", d.step, d.wall, d.stepping); };
  for (Duration const& d : read_durations(results)) {
    std::error_code not_known;
    if (d.step != checkpoint.step && std::filesystem::exists(checkpoint_path(results, d.step), not_known)) add(d);
  }
  add({checkpoint.step, checkpoint.wall_seconds, checkpoint.stepping_seconds});
  write_whole_file(durations_path(results), text);
}

void find_duration(std::filesystem::path const& results, Checkpoint& checkpoint) {
  for (Duration const& d : read_durations(results)) {
    if (d.step != checkpoint.step) continue;
    checkpoint.wall_seconds = d.wall;
    checkpoint.stepping_seconds = d.stepping;
  }
}

}  // namespace

void NamedState::put(std::string_view name, std::span<double const> values) {
  PIOLA_EXPECTS(!name.empty());
  arrays_.insert_or_assign(std::string(name), std::vector<double>(values.begin(), values.end()));
}

std::vector<double> const& NamedState::all(std::string_view name) const {
  auto const found = arrays_.find(name);
  if (found == arrays_.end()) throw FileError(no_such_name(name));
  return found->second;
}

void NamedState::get(std::string_view name, std::span<double> values) {
  auto const& kept = all(name);
  demand_size(name, kept.size(), values.size());
  std::copy(kept.begin(), kept.end(), values.begin());
}

namespace {

/// All but the state of formulation and observers.
void put_words(Checkpoint const& c, hdf5::Writer& file) {
  file.attribute("/", "piola_checkpoint", std::array{layout_version});
  file.attribute("/", "version", c.version);
  file.attribute("/", "machine", c.backend);
  file.attribute("/", "time", c.time);
  file.attribute("/", "step", std::array{c.step});
  file.attribute("/", "dt", c.dt);
  file.attribute("/", "first_dt", c.first_dt);
  file.attribute("/", "cut_to_end", std::array<std::int64_t, 1>{c.cut_to_end ? 1 : 0});
  file.dataset<char>("/case", std::span<char const>(c.source));
  file.dataset<char>("/particles", std::span<char const>(c.particles));
}

}  // namespace

void write_checkpoint(std::filesystem::path const& path, Checkpoint const& c,
                      std::function<void(StateWriter&)> const& save) {
  PIOLA_EXPECTS(c.step >= 0);
  std::optional<hdf5::Writer> file;  // on rank 0
  comm::on_root([&] {
    make_folder(path.parent_path());
    file.emplace(path);
    put_words(c, *file);
    for (char const* const group : {"/state", "/observers"}) file->group(group);
  });
  GroupWriter state(file ? &*file : nullptr, "/state"), observers(file ? &*file : nullptr, "/observers");
  if (save)
    save(state);
  else
    put_all(c.state, state);
  state.end_rows();
  put_all(c.observers, observers);
  observers.end_rows();
  comm::on_root([&] { file->finish(); });
}

namespace {

/// All but the state.
Checkpoint read_words(hdf5::Reader const& file, std::filesystem::path const& path) {
  if (file.integer("/", "piola_checkpoint") != layout_version) {
    throw FileError(fmt::format(
        "{}: was written in another layout of checkpoints - resume with the version that wrote it", path.string()));
  }
  Checkpoint c;
  c.version = file.text("/", "version");
  c.backend = file.text("/", "machine");
  c.time = file.number("/", "time");
  c.step = file.integer("/", "step");
  c.dt = file.number("/", "dt");
  c.first_dt = file.number("/", "first_dt");
  c.cut_to_end = file.integer("/", "cut_to_end") != 0;
  auto const source = file.dataset<char>("/case"), particles = file.dataset<char>("/particles");
  c.source.assign(source.begin(), source.end());
  c.particles.assign(particles.begin(), particles.end());
  c.observers = get_state(file, "/observers");
  return c;
}

void broadcast(std::vector<double>& values) {
  values.resize(comm::of_root(values.size()));
  comm::broadcast_bytes(values.data(), values.size() * sizeof(double));
}

/// Gives all ranks the numbers of a checkpoint and the state of its observers. Collective.
void broadcast(Checkpoint& c) {
  std::array numbers{c.time, c.dt, c.first_dt, c.wall_seconds, c.stepping_seconds, c.cut_to_end ? 1.0 : 0.0};
  numbers = comm::of_root(numbers);
  c.time = numbers[0];
  c.dt = numbers[1];
  c.first_dt = numbers[2];
  c.wall_seconds = numbers[3];
  c.stepping_seconds = numbers[4];
  c.cut_to_end = numbers[5] != 0;
  c.step = comm::of_root(c.step);
  auto const arrays = c.observers.arrays();
  auto next = arrays.begin();
  for (std::size_t k = comm::of_root(arrays.size()); k > 0; --k) {
    std::string name = next == arrays.end() ? "" : next->first;
    std::vector<double> values = next == arrays.end() ? std::vector<double>() : next->second;
    name.resize(comm::of_root(name.size()));
    comm::broadcast_bytes(name.data(), name.size());
    broadcast(values);
    c.observers.put(name, values);
    if (next != arrays.end()) ++next;
  }
}

}  // namespace

Checkpoint read_checkpoint(std::filesystem::path const& path) {
  hdf5::Reader const file(path);
  Checkpoint c = read_words(file, path);
  c.state = get_state(file, "/state");
  return c;
}

std::filesystem::path checkpoint_path(std::filesystem::path const& results, std::int64_t step) {
  PIOLA_EXPECTS(step >= 0);
  return results / "checkpoints" / fmt::format("{:09}.h5", step);
}

std::vector<std::filesystem::path> list_checkpoints(std::filesystem::path const& results) {
  std::vector<std::filesystem::path> found;
  std::error_code missing_folder;
  for (auto const& entry : std::filesystem::directory_iterator(results / "checkpoints", missing_folder)) {
    std::string const stem = entry.path().stem().string();
    bool const number =
        !stem.empty() && std::all_of(stem.begin(), stem.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (number && entry.path().extension() == ".h5") found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end(), std::greater<>());
  return found;
}

void keep_checkpoint(std::filesystem::path const& results, Checkpoint const& checkpoint,
                     std::function<void(StateWriter&)> const& save) {
  write_checkpoint(checkpoint_path(results, checkpoint.step), checkpoint, save);
  comm::on_root([&] {
    auto const all = list_checkpoints(results);
    std::error_code kept_all_the_same;
    for (std::size_t k = 2; k < all.size(); ++k) std::filesystem::remove(all[k], kept_all_the_same);
    keep_duration(results, checkpoint);
  });
}

namespace {

/// Opens a checkpoint on rank 0 and gives all ranks what is not the state of the formulation or text, which rank 0
/// compares with its case. Collective.
Checkpoint open_checkpoint(std::filesystem::path const& results, std::filesystem::path const& path) {
  Checkpoint c;
  std::shared_ptr<StateReader> state;
  comm::on_root([&] {
    auto const file = std::make_shared<hdf5::Reader const>(path);
    c = read_words(*file, path);
    state = std::make_shared<GroupReader>(file, "/state");
    find_duration(results, c);
  });
  broadcast(c);
  c.in_file = comm::is_parallel() ? std::make_shared<BroadcastReader>(std::move(state)) : std::move(state);
  return c;
}

/// Whether no older checkpoint can help.
bool is_final(std::exception_ptr const& error) {
  try {
    std::rethrow_exception(error);
  } catch (InputError const&) {
    return true;
  } catch (std::bad_alloc const&) {
    return true;
  } catch (comm::CollectiveError const& e) {
    return e.code() == bad_input;
  } catch (...) {
    return false;
  }
}

}  // namespace

bool use_newest_checkpoint(std::filesystem::path const& results, std::vector<std::string>& warnings,
                           std::function<bool(Checkpoint&)> const& use) {
  PIOLA_EXPECTS(use != nullptr);
  bool declined = false;
  std::vector<std::filesystem::path> paths = list_checkpoints(results);
  paths.resize(comm::of_root(paths.size()));  // other ranks need no paths
  for (auto const& path : paths) {
    try {
      Checkpoint checkpoint = open_checkpoint(results, path);
      if (use(checkpoint)) return true;
      declined = true;
    } catch (std::exception const& error) {
      if (is_final(std::current_exception())) throw;
      std::string const what = error.what();
      bool const named = what.starts_with(path.string());
      warnings.push_back(
          fmt::format("{}{}; the checkpoint before it is used", named ? "" : path.string() + ": ", what));
    }
  }
  if (declined) return false;
  std::string reasons;
  for (std::string const& warning : warnings) reasons += "\n" + warning.substr(0, warning.rfind(';'));
  throw InputError(
      fmt::format("{}: holds no checkpoint that can be used (a run writes checkpoints/*.h5) - run the case again{}",
                  results.string(), reasons));
}

}  // namespace piola
