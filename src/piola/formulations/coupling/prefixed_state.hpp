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
struct GroupIndex {
  std::size_t part, parts;
  DistributedRows of_whole(DistributedRows rows) const {
    rows.set = rows.set * static_cast<std::int64_t>(parts) + static_cast<std::int64_t>(part);
    return rows;
  }
};

/// Prefixes the names of a part's arrays in a checkpoint with its formulation.
class PrefixedStateWriter : public StateWriter {
 public:
  PrefixedStateWriter(StateWriter& whole, std::string prefix, GroupIndex number)
      : whole_(whole), prefix_(std::move(prefix)), number_(number) {}
  void put(std::string_view name, std::span<double const> values) override {
    whole_.put(prefix_ + std::string(name), values);
  }
  void put_rows(std::string_view name, DistributedRows const& rows, std::span<double const> values) override {
    whole_.put_rows(prefix_ + std::string(name), number_.of_whole(rows), values);
  }

 private:
  StateWriter& whole_;
  std::string prefix_;
  GroupIndex number_;
};

class PrefixedStateReader : public StateReader {
 public:
  PrefixedStateReader(StateReader& whole, std::string prefix, GroupIndex number)
      : whole_(whole), prefix_(std::move(prefix)), number_(number) {}
  void get(std::string_view name, std::span<double> values) override {
    whole_.get(prefix_ + std::string(name), values);
  }
  void get_on_root(std::string_view name, std::span<double> values) override {
    whole_.get_on_root(prefix_ + std::string(name), values);
  }
  void get_rows(std::string_view name, DistributedRows const& rows, std::span<double> values) override {
    whole_.get_rows(prefix_ + std::string(name), number_.of_whole(rows), values);
  }

 private:
  StateReader& whole_;
  std::string prefix_;
  GroupIndex number_;
};

}  // namespace piola
