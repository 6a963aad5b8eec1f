// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

/// Saves the state of several formulations in one checkpoint and loads it.
namespace piola {

/// Index of a formulation and their number; each formulation numbers its sets of rows independently.
struct PartNumber {
  std::size_t part, parts;
  RowsOfRanks of_whole(RowsOfRanks rows) const {
    rows.set = rows.set * static_cast<std::int64_t>(parts) + static_cast<std::int64_t>(part);
    return rows;
  }
};

/// Prefixes the names of a part's arrays in a checkpoint with its formulation.
class PartWriter : public StateWriter {
 public:
  PartWriter(StateWriter& whole, std::string prefix, PartNumber number)
      : whole_(whole), prefix_(std::move(prefix)), number_(number) {}
  void put(std::string_view name, std::span<double const> values) override {
    whole_.put(prefix_ + std::string(name), values);
  }
  void put_rows(std::string_view name, RowsOfRanks const& rows, std::span<double const> values) override {
    whole_.put_rows(prefix_ + std::string(name), number_.of_whole(rows), values);
  }

 private:
  StateWriter& whole_;
  std::string prefix_;
  PartNumber number_;
};

class PartReader : public StateReader {
 public:
  PartReader(StateReader& whole, std::string prefix, PartNumber number)
      : whole_(whole), prefix_(std::move(prefix)), number_(number) {}
  void get(std::string_view name, std::span<double> values) override {
    whole_.get(prefix_ + std::string(name), values);
  }
  void get_to_deal(std::string_view name, std::span<double> values) override {
    whole_.get_to_deal(prefix_ + std::string(name), values);
  }
  void get_rows(std::string_view name, RowsOfRanks const& rows, std::span<double> values) override {
    whole_.get_rows(prefix_ + std::string(name), number_.of_whole(rows), values);
  }

 private:
  StateReader& whole_;
  std::string prefix_;
  PartNumber number_;
};

}  // namespace piola
