// SPDX-License-Identifier: Apache-2.0
#include "piola/output/collective_table_reader.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace piola {

std::unique_ptr<SharedFile> open_on_all(std::filesystem::path const& of_first, SharedFile::To to) {
  std::string path = comm::rank() == 0 ? std::filesystem::absolute(of_first).string() : "";
  std::array<std::uint64_t, 2> about{path.size(), SharedFile::number(path)};
  comm::broadcast_bytes(about.data(), sizeof about);
  path.resize(about[0]);
  comm::broadcast_bytes(path.data(), path.size());
  auto file = std::make_unique<SharedFile>(path, about[1], to);
  double blind = file->is_open() ? 0 : 1;
  comm::allreduce_max(blind);
  if (blind > 0) file.reset();
  return file;
}

bool CollectiveTableReader::read(std::optional<FileExtent> const& place, DistributedRows const& rows,
                                 std::span<double> values) {
  PIOLA_EXPECTS(rows.columns >= 1 && rows.count >= 0);
  PIOLA_EXPECTS(values.size() % static_cast<std::size_t>(rows.columns) == 0);
  std::array<std::uint64_t, 2> about{place ? 1U : 0U, place ? place->at : 0};
  comm::broadcast_bytes(about.data(), sizeof about);
  if (about[0] == 0) return false;
  if (!std::exchange(begun_, true)) file_ = open_on_all(place ? place->path : "", SharedFile::To::read);
  if (!file_) return false;
  RedistributionPlan const& way = plans_.try_emplace(rows.set, rows, rows_of_pages).first->second;
  auto const width = static_cast<std::uint64_t>(rows.columns);
  std::vector<double> whole(static_cast<std::uint64_t>(way.own().last - way.own().first) * width);
  std::uint64_t const at = about[1] + static_cast<std::uint64_t>(way.own().first) * width * sizeof(double);
  double failed = file_->read(at, std::as_writable_bytes(std::span(whole))) ? 0 : 1;
  comm::allreduce_max(failed);
  if (failed > 0) return false;
  way.from_file_order<double>(whole, values, rows.columns);
  return true;
}

}  // namespace piola
