// SPDX-License-Identifier: Apache-2.0
// On one rank; several are for ranks_test.py and ranks_faults_test.py.
#include "piola/output/collective_table_writer.hpp"
#include "piola/base/errors.hpp"
#include "piola/output/collective_table_reader.hpp"
#include "piola/output/hdf5.hpp"
#include "support/temporary_folder.hpp"
#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <numeric>

namespace piola {
namespace {

using hdf5::Storage;

/// Numbers 0, 1, 2, ... of a table, and its rows in another order.
struct Table {
  Index rows;
  int columns;
  std::vector<double> values, shuffled;
  std::vector<Index> places;
  Table(Index n, int width) : rows(n), columns(width) {
    values.resize(static_cast<std::size_t>(n) * static_cast<std::size_t>(width));
    std::iota(values.begin(), values.end(), 0.0);
    constexpr Index stride = 7919;  // a prime
    for (Index k = 0; k < n; ++k) {
      places.push_back(static_cast<Index>(std::int64_t{k} * stride % n));
      for (int c = 0; c < width; ++c) shuffled.push_back(static_cast<double>(std::int64_t{places.back()} * width + c));
    }
  }
  DistributedRows of(int set = 0) const { return {.set = set, .count = rows, .places = places, .columns = columns}; }
};

class RowWriterStores : public ::testing::TestWithParam<Storage> {};

TEST_P(RowWriterStores, RowsInOrderInASealedFile) {
  testing::TemporaryFolder const folder;
  Table const large(100'000, 3), small(5, 2);  // several chunks, part of a page
  {
    hdf5::Writer file(folder / "a.h5");
    file.group("/more");
    CollectiveTableWriter rows(&file);
    rows.put<double>("/large", large.of(), large.shuffled, GetParam());
    rows.put<double>("/more/small", small.of(1), small.shuffled, GetParam());
    rows.put<double>("/none", {.set = 2}, {}, GetParam());
    file.dataset<double>("/ordinary", std::array{1.0, 2.0});
    rows.end();
    file.finish();
  }
  hdf5::Reader const back(folder / "a.h5");  // checks the seal
  auto const columns = [&](int of) { return GetParam() == Storage::sequence ? 1U : static_cast<unsigned>(of); };
  EXPECT_EQ(back.dataset<double>("/large", columns(3)), large.values);
  EXPECT_EQ(back.dataset<double>("/more/small", columns(2)), small.values);
  EXPECT_TRUE(back.dataset<double>("/none").empty());
  EXPECT_EQ(back.dataset<double>("/ordinary"), (std::vector<double>{1, 2}));
  EXPECT_EQ(back.place_of_doubles("/large").has_value(), GetParam() == Storage::sequence);
}
INSTANTIATE_TEST_SUITE_P(Rows, RowWriterStores,
                         ::testing::Values(Storage::contiguous, Storage::sequence, Storage::compressed));

/// Writes a file with this table alone; returns the file offset of its values.
std::uint64_t write(std::filesystem::path const& path, Table const& table) {
  hdf5::Writer file(path);
  CollectiveTableWriter rows(&file);
  rows.put<double>("/t", table.of(), table.shuffled, Storage::sequence);
  rows.end();
  file.finish();
  return hdf5::Reader(path).place_of_doubles("/t").value();
}

TEST(CollectiveTableReader, ReadsWhatRowWriterWrote) {
  testing::TemporaryFolder const folder;
  Table const table(20'000, 2);
  std::uint64_t const at = write(folder / "a.h5", table);
  std::vector<double> values(table.shuffled.size());
  CollectiveTableReader reader;
  EXPECT_TRUE(reader.read(FileExtent{folder / "a.h5", at}, table.of(), values));
  EXPECT_EQ(values, table.shuffled);
  EXPECT_FALSE(reader.read(std::nullopt, table.of(), values));
  EXPECT_FALSE(reader.read(FileExtent{folder / "a.h5", at + 1'000'000}, table.of(), values));  // the end comes before
  EXPECT_FALSE(CollectiveTableReader().read(FileExtent{folder / "absent.h5", at}, table.of(), values));
}

TEST(CollectiveTableWriter, DamageOfARowBreaksTheSeal) {
  testing::TemporaryFolder const folder;
  Table const table(10'000, 1);
  std::uint64_t const at = write(folder / "a.h5", table);
  std::fstream(folder / "a.h5", std::ios::in | std::ios::out | std::ios::binary).seekp(static_cast<long>(at + 8000))
      << 'x';
  EXPECT_THROW(hdf5::Reader(folder / "a.h5"), FileError);
}

TEST(SharedFile, WritesBesideTheOneWhoMadeTheFile) {
  testing::TemporaryFolder const folder;
  AtomicFile file(folder / "a");
  std::string const mine = "mine", other = "other";
  SharedFile joined(file.part(), SharedFile::number(file.part()));
  ASSERT_TRUE(joined.is_open());
  joined.write(4, std::as_bytes(std::span(other)));
  EXPECT_EQ(joined.close(), 0);
  file.write(0, std::as_bytes(std::span(mine)));
  file.finish(mine.size() + other.size());
  EXPECT_EQ(testing::text_of(folder / "a"), "mineother");
}

TEST(SharedFile, OpensNoOtherFileOfThatName) {
  testing::TemporaryFolder const folder;
  AtomicFile const file(folder / "a");
  EXPECT_FALSE(SharedFile(file.part(), SharedFile::number(file.part()) + 1).is_open());
  EXPECT_FALSE(SharedFile(folder / "absent", 7).is_open());
  EXPECT_EQ(SharedFile::number(folder / "absent"), 0U);
}

}  // namespace
}  // namespace piola
