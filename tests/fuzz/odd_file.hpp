// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/checksum_trailer.hpp"
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <hdf5.h>
#include <string>
#include <unistd.h>
#include <vector>

namespace piola::fuzz {

/// Decodes the input of a fuzz target as a sequence of choices, one character each. "0" is the ordinary choice, also
/// after the end of the input. People can read and write such inputs.
class Choices {
 public:
  Choices(std::uint8_t const* data, std::size_t size) : data_(data), size_(size) {}
  unsigned next(unsigned count) {
    if (at_ >= size_) return 0;
    return static_cast<std::uint8_t>(data_[at_++] - '0') % count;
  }

 private:
  std::uint8_t const* data_;
  std::size_t size_, at_ = 0;
};

/// A temporary file with one path per process and name, reused for all inputs. The destructor removes it.
class ScratchFile {
 public:
  explicit ScratchFile(std::string const& name)
      : path_(std::filesystem::temp_directory_path() / ("piola-fuzz-" + std::to_string(::getpid()) + "-" + name)) {}
  ~ScratchFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  std::filesystem::path const& path() const { return path_; }
  void write(std::string_view text) const { std::ofstream(path_, std::ios::binary) << text; }
  void seal() const {
    std::ifstream in(path_, std::ios::binary);
    std::string const text{std::istreambuf_iterator<char>(in), {}};
    CheckSum sum;
    sum.add(text);
    std::ofstream(path_, std::ios::binary | std::ios::app) << checksum_trailer_of(sum, text.size());
  }

 private:
  std::filesystem::path path_;
};

/// Writes an HDF5 file with defects. Choices decide for each object whether it is correct, missing, or of another shape
/// or type. Closing the file closes all remaining HDF5 identifiers (H5F_CLOSE_STRONG).
class OddFile {
 public:
  OddFile(std::filesystem::path const& path, Choices& choices) : choices_(choices) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    hid_t const access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    file_ = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
    H5Pclose(access);
    links_ = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_create_intermediate_group(links_, 1);
  }
  ~OddFile() {
    H5Pclose(links_);
    H5Fclose(file_);
  }
  OddFile(OddFile const&) = delete;
  OddFile& operator=(OddFile const&) = delete;

  void group(char const* path) { H5Gcreate2(file_, path, links_, H5P_DEFAULT, H5P_DEFAULT); }

  template <class T>
  void dataset(char const* path, hid_t type, std::vector<hsize_t> shape, std::vector<T> const& values) {
    unsigned const how = choices_.next(5);
    if (how == 1) return;
    if (how == 4) return group(path);
    bool const ordinary = how == 0;
    if (how == 2) shape = odd_shape();
    if (how == 3) type = odd_type();
    hid_t const space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
    hid_t const made = H5Dcreate2(file_, path, type, space, links_, H5P_DEFAULT, H5P_DEFAULT);
    if (ordinary) H5Dwrite(made, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
  }

  template <class T>
  void attribute(char const* object, char const* name, hid_t type, T const* value) {
    unsigned const how = choices_.next(4);
    if (how == 1) return;
    std::vector<hsize_t> const shape = how == 2 ? odd_shape() : std::vector<hsize_t>{1};
    if (how == 3) type = odd_type();
    hid_t const space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
    hid_t const made = H5Acreate_by_name(file_, object, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    if (how == 0) H5Awrite(made, type, value);
    H5Sclose(space);
  }

  void text(char const* object, char const* name, std::string const& value) {
    hid_t const type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, value.size());
    attribute(object, name, type, value.data());
    H5Tclose(type);
  }

 private:
  std::vector<hsize_t> odd_shape() {
    constexpr std::array<hsize_t, 6> sizes{0, 1, 2, 9, 700, hsize_t{1} << 41};
    std::vector<hsize_t> shape(choices_.next(4));
    for (hsize_t& size : shape) size = sizes[choices_.next(sizes.size())];
    return shape;
  }
  hid_t odd_type() {
    static hid_t const variable = [] {
      hid_t const type = H5Tcopy(H5T_C_S1);
      H5Tset_size(type, H5T_VARIABLE);
      return type;
    }();
    constexpr hsize_t width = 300;
    static std::array<hid_t, 9> const types{H5T_NATIVE_DOUBLE,
                                            H5T_NATIVE_FLOAT,
                                            H5T_NATIVE_INT64,
                                            H5T_NATIVE_INT8,
                                            H5T_C_S1,
                                            variable,
                                            H5Tarray_create2(H5T_NATIVE_DOUBLE, 1, &width),
                                            H5Tcreate(H5T_COMPOUND, 16),
                                            H5T_NATIVE_LDOUBLE};
    return types[choices_.next(types.size())];
  }

  Choices& choices_;
  hid_t file_, links_;
};

}  // namespace piola::fuzz
