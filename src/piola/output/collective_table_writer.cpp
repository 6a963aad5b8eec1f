// SPDX-License-Identifier: Apache-2.0
#include "piola/output/collective_table_writer.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/domain/error_agreement.hpp"
#include "piola/output/collective_table_reader.hpp"
#include "piola/output/deflate.hpp"
#include "piola/output/hdf5.hpp"
#include <algorithm>
#include <array>
#include <cstdint>
#include <fmt/format.h>

namespace piola {
namespace {

/// The rows of a rank's stretch in order: those that are there already, or what comes from all ranks.
template <class T>
class Stretch {
 public:
  Stretch(RedistributionPlan const& plan, DistributedRows const& rows, std::span<T const> values) : values_(values) {
    if (!comm::is_parallel() && !rows.places) return;
    collected_ = plan.collect(values, rows.columns);
    values_ = collected_;
  }
  std::span<T const> values() const { return values_; }

 private:
  std::vector<T> collected_;
  std::span<T const> values_;
};

}  // namespace

void CollectiveTableWriter::join() {
  if (std::exchange(begun_, true) || !comm::is_parallel()) return;
  joined_ = open_on_all(file_ != nullptr ? file_->part() : "", SharedFile::To::write);
  all_see_ = joined_ != nullptr;
  if (file_ != nullptr) joined_.reset();
}

RedistributionPlan const& CollectiveTableWriter::plan(DistributedRows const& rows, Index block) {
  if (comm::is_parallel() && !all_see_) block = rows.count;
  auto const at = plans_.find({rows.set, block});
  return at != plans_.end() ? at->second : plans_.try_emplace({rows.set, block}, rows, block).first->second;
}

template <class F>
std::optional<std::vector<std::uint64_t>> CollectiveTableWriter::by_first(std::size_t count, F const& f) {
  std::vector<std::uint64_t> said(count + 1, 0);  // the last one: whether there are any
  try_on_root([&] {
    auto const places = f();
    std::copy(places.begin(), places.end(), said.begin());
    said.back() = 1;
  });
  comm::broadcast_bytes(said.data(), said.size() * sizeof said.front());
  if (said.back() == 0) return std::nullopt;
  said.pop_back();
  return said;
}

void CollectiveTableWriter::write_at(std::uint64_t at, std::span<std::byte const> bytes) {
  if (bytes.empty()) return;
  if (file_ != nullptr) return file_->put_at(at, bytes);
  joined_->write(at, bytes);
  written_.push_back(hdf5::part_of(at, bytes));
}

template <class T>
void CollectiveTableWriter::put_contiguous(std::string const& path, DistributedRows const& rows,
                                           std::span<T const> values, bool columns) {
  auto const place = by_first(1, [&] {
    auto const count = static_cast<std::uint64_t>(rows.count), width = static_cast<std::uint64_t>(rows.columns);
    return std::array{columns ? file_->reserve<T>(path, count, rows.columns)
                              : file_->reserve<T>(path, count * width, 1)};
  });
  if (!place || rows.count == 0) return;
  RedistributionPlan const& way = plan(rows, rows_of_pages);
  Stretch<T> const own(way, rows, values);
  auto const before = static_cast<std::uint64_t>(way.own().first) * static_cast<std::uint64_t>(rows.columns);
  write_at(place->front() + before * sizeof(T), std::as_bytes(own.values()));
}

template <class T>
void CollectiveTableWriter::put_chunks(std::string const& path, DistributedRows const& rows,
                                       std::span<T const> values) {
  auto const count = static_cast<std::uint64_t>(rows.count);
  std::uint64_t const of_chunk = hdf5::chunk_rows(count, rows.columns, sizeof(T));
  RedistributionPlan const& way = plan(rows, static_cast<Index>(of_chunk));
  std::vector<std::vector<std::byte>> chunks;
  {
    Stretch<T> const own(way, rows, values);
    chunks = deflate_chunks(std::as_bytes(own.values()), sizeof(T) * of_chunk * static_cast<std::size_t>(rows.columns),
                            sizeof(T));
  }
  std::vector<double> sizes;
  for (auto const& chunk : chunks) sizes.push_back(static_cast<double>(chunk.size()));
  sizes = comm::gather(sizes);
  auto const places = by_first((count + of_chunk - 1) / of_chunk, [&] {
    std::vector<std::uint64_t> const bytes(sizes.begin(), sizes.end());
    return file_->reserve_chunks<T>(path, count, rows.columns, bytes);
  });
  if (!places) return;
  std::size_t k = static_cast<std::size_t>(way.own().first) / of_chunk;
  for (auto const& chunk : chunks) write_at((*places)[k++], chunk);
}

template <class T>
void CollectiveTableWriter::put(std::string const& path, DistributedRows const& rows, std::span<T const> values,
                                hdf5::Storage storage) {
  PIOLA_EXPECTS(!ended_ && rows.columns >= 1 && rows.count >= 0);
  PIOLA_EXPECTS(values.size() % static_cast<std::size_t>(rows.columns) == 0);
  join();
  if (storage == hdf5::Storage::compressed && rows.count > 1)
    put_chunks(path, rows, values);
  else
    put_contiguous(path, rows, values, storage != hdf5::Storage::sequence);
}
template void CollectiveTableWriter::put(std::string const&, DistributedRows const&, std::span<float const>,
                                         hdf5::Storage);
template void CollectiveTableWriter::put(std::string const&, DistributedRows const&, std::span<double const>,
                                         hdf5::Storage);
template void CollectiveTableWriter::put(std::string const&, DistributedRows const&, std::span<std::int64_t const>,
                                         hdf5::Storage);
template void CollectiveTableWriter::put(std::string const&, DistributedRows const&, std::span<std::uint8_t const>,
                                         hdf5::Storage);

void CollectiveTableWriter::end() {
  if (std::exchange(ended_, true)) return;
  if (comm::is_parallel()) {
    std::vector<double> said{static_cast<double>(joined_ ? joined_->close() : 0), static_cast<double>(written_.size())};
    for (hdf5::WrittenPart const& part : written_)
      said.insert(said.end(),
                  {static_cast<double>(part.at), static_cast<double>(part.bytes), static_cast<double>(part.check_sum)});
    said = comm::gather(said);
    int rank = 0;
    for (std::size_t k = 0; k < said.size(); ++rank) {
      int const error = static_cast<int>(said[k++]);
      if (error != 0 && !trouble_)
        trouble_ = std::make_exception_ptr(
            FileError(fmt::format("{} (on rank {})", write_error_text(file_->path(), error), rank)));
      for (auto parts = static_cast<std::size_t>(said[k++]); parts > 0; --parts, k += 3)
        file_->note({static_cast<std::uint64_t>(said[k]), static_cast<std::uint64_t>(said[k + 1]),
                     static_cast<std::uint32_t>(said[k + 2])});
    }
  }
  comm::agree_after([&] {
    if (trouble_) std::rethrow_exception(trouble_);
  });
}

}  // namespace piola
