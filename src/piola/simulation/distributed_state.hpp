// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/communicator.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/output/collective_table_reader.hpp"
#include "piola/output/collective_table_writer.hpp"
#include <exception>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>

/// Collective saving and loading of the state of a distributed formulation.
namespace piola {

/// Thrown on other ranks when rank 0 could not read from a checkpoint.
struct MissingOnRoot : std::runtime_error {
  MissingOnRoot() : std::runtime_error("rank 0 could not read a checkpoint") {}
};

/// Reads on rank 0 and broadcasts the values. All members are collective.
class BroadcastReader final : public StateReader {
 public:
  explicit BroadcastReader(StateReader* of_first) : reader_(of_first) {}
  void get(std::string_view name, std::span<double> values) override {
    get_on_root(name, values);
    comm::broadcast_bytes(values.data(), values.size_bytes());
  }
  void get_on_root(std::string_view name, std::span<double> values) override {
    on_root([&] { reader_->get(name, values); });
  }
  void get_rows(std::string_view name, DistributedRows const& rows, std::span<double> values) override {
    std::optional<FileExtent> place;
    on_root([&] { place = reader_->place(name, value_count(rows)); });
    if (!rows_.read(place, rows, values)) StateReader::get_rows(name, rows, values);
  }

 private:
  /// Calls f on rank 0. If it throws there, all ranks throw.
  template <class F>
  void on_root(F const& f) {
    int good = 1;
    std::exception_ptr trouble;
    if (reader_ != nullptr) try {
        f();
      } catch (...) {
        trouble = std::current_exception();
        good = 0;
      }
    comm::broadcast_bytes(&good, sizeof good);
    if (trouble) std::rethrow_exception(trouble);
    if (good == 0) throw MissingOnRoot();
  }

  CollectiveTableReader rows_;
  StateReader* reader_;
};

/// Stores the first error until all data are written, because other ranks take part in the collective calls. raise()
/// throws it.
class DeferredErrorWriter final : public StateWriter {
 public:
  explicit DeferredErrorWriter(StateWriter& writer) : writer_(writer) {}
  void put(std::string_view name, std::span<double const> values) override {
    if (!trouble_) keep_trouble([&] { writer_.put(name, values); });
  }
  void put_rows(std::string_view name, DistributedRows const& rows, std::span<double const> values) override {
    keep_trouble([&] { writer_.put_rows(name, rows, values); });
  }
  void end_rows() override {
    keep_trouble([&] { writer_.end_rows(); });
  }
  void raise() const {
    if (trouble_) std::rethrow_exception(trouble_);
  }

 private:
  template <class F>
  void keep_trouble(F const& f) {
    try {
      f();
    } catch (...) {
      if (!trouble_) trouble_ = std::current_exception();
    }
  }
  StateWriter& writer_;
  std::exception_ptr trouble_;
};

/// For ranks that take part in put_rows() of rank 0.
class NullStateWriter : public StateWriter {
 public:
  void put(std::string_view, std::span<double const>) override {}
};

/// For ranks that write parts of the file that rank 0 has open.
class LocalRowsWriter final : public NullStateWriter {
 public:
  void put_rows(std::string_view, DistributedRows const& rows, std::span<double const> values) override {
    rows_.put("", rows, values);
  }
  Rows rows() const override { return Rows::to_file; }
  void end_rows() override { rows_.end(); }

 private:
  CollectiveTableWriter rows_{nullptr};
};

}  // namespace piola
