// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/error_agreement.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/output/collective_table_reader.hpp"
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

namespace piola {

/// Reads values on rank 0 and broadcasts them; tables are read by all ranks. If a value cannot be read, all ranks throw
/// comm::CollectiveError. All members are collective.
class BroadcastReader final : public StateReader {
 public:
  /// reader: on rank 0; null on other ranks.
  explicit BroadcastReader(std::shared_ptr<StateReader> reader) : reader_(std::move(reader)) {}
  void get(std::string_view name, std::span<double> values) override {
    get_on_root(name, values);
    comm::broadcast_bytes(values.data(), values.size_bytes());
  }
  void get_on_root(std::string_view name, std::span<double> values) override {
    comm::on_root([&] { reader_->get(name, values); });
  }
  void get_rows(std::string_view name, DistributedRows const& rows, std::span<double> values) override {
    std::optional<FileExtent> place;
    comm::on_root([&] { place = reader_->place(name, value_count(rows)); });
    if (!rows_.read(place, rows, values)) StateReader::get_rows(name, rows, values);
  }

 private:
  CollectiveTableReader rows_;
  std::shared_ptr<StateReader> reader_;
};

}  // namespace piola
