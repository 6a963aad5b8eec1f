// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "piola/base/read_file.hpp"
#include "piola/output/checksum_trailer.hpp"
#include "piola/output/hdf5.hpp"
#include "piola/output/hdf5_types.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <type_traits>

namespace piola::hdf5 {
namespace {

// Deflate packs at most 1032 bytes into one, which bounds the content of a file whatever its header claims.
constexpr std::uintmax_t most_packing = 1032;
constexpr std::size_t longest_text = 65536;  // HDF5 itself allows no longer attribute in these files

Handle open_file(std::filesystem::path const& path) {
  disable_error_stack();
  if (FileToRead const file(path); !file.problem().empty())  // HDF5 would block on a pipe without a writer
    throw FileError(path.string() + ": " + file.problem());
  hid_t const id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0) throw FileError(fmt::format("{}: is no HDF5 file or is cut off - write it again", path.string()));
  return {id, H5Fclose, path.string()};
}

Handle open_sealed(std::filesystem::path const& path) {
  verify_checksum_trailer(path);
  return open_file(path);
}

/// Whether values of a type in the file may be read as T.
template <class T>
bool readable_as(hid_t type) {
  H5T_class_t const kind = H5Tget_class(type);
  std::size_t const size = H5Tget_size(type);
  bool const plain = size == 1 || size == 2 || size == 4 || size == 8;
  return plain && (kind == H5T_INTEGER || (kind == H5T_FLOAT && std::is_floating_point_v<T>));
}

}  // namespace

Reader::Reader(std::filesystem::path const& path) : Reader(path, open_sealed(path), true) {}

Reader::Reader(std::filesystem::path const& path, Handle file, bool sealed)
    : path_(path), bytes_(std::filesystem::file_size(path)), sealed_(sealed), file_(std::move(file)) {}

Reader Reader::unsealed(std::filesystem::path const& path) { return {path, open_file(path), false}; }

void Reader::fail(std::string_view what, std::string_view why) const {
  throw FileError(
      fmt::format("{}: '{}' {} - the file is damaged or was written by another program", path_.string(), what, why));
}

bool Reader::has(std::string const& path) const { return H5Lexists(file_.id(), path.c_str(), H5P_DEFAULT) > 0; }

std::vector<std::string> Reader::names(std::string const& group) const {
  hid_t const id = has(group) ? H5Gopen2(file_.id(), group.c_str(), H5P_DEFAULT) : -1;
  if (id < 0) fail(group, "is missing or no group");
  Handle const owner(id, H5Gclose, group);
  std::vector<std::string> found;
  auto const add = [](hid_t, char const* name, H5L_info_t const*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  if (H5Literate(owner.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &found) < 0) fail(group, "cannot be listed");
  return found;
}

Handle Reader::open_dataset(std::string const& path) const {
  hid_t const id = has(path) ? H5Dopen2(file_.id(), path.c_str(), H5P_DEFAULT) : -1;
  if (id < 0) fail(path, "is missing or no data set");
  return {id, H5Dclose, path};
}

std::vector<std::uint64_t> Reader::shape(hid_t dataset, std::string const& path) const {
  Handle const space(H5Dget_space(dataset), H5Sclose, path);
  std::array<hsize_t, H5S_MAX_RANK> dims{};
  bool const simple = H5Sget_simple_extent_type(space.id()) == H5S_SIMPLE;
  int const rank = simple ? H5Sget_simple_extent_dims(space.id(), dims.data(), nullptr) : 0;
  if (rank != 1 && rank != 2) fail(path, "is neither a list nor a table");
  return {dims.begin(), dims.begin() + rank};
}

std::uint64_t Reader::columns(std::string const& dataset) const {
  auto const dims = shape(open_dataset(dataset).id(), dataset);
  return dims.size() == 1 ? 1 : dims[1];
}

std::vector<std::uint64_t> Reader::shape_of_numbers(std::string const& path) const {
  hid_t const id = has(path) ? H5Oopen(file_.id(), path.c_str(), H5P_DEFAULT) : -1;
  if (id < 0) return {};
  Handle const object(id, H5Oclose, path);
  if (H5Iget_type(id) != H5I_DATASET) return {};
  Handle const type(H5Dget_type(id), H5Tclose, path);
  Handle const space(H5Dget_space(id), H5Sclose, path);
  int const rank = H5Sget_simple_extent_ndims(space.id());
  bool const numbers = readable_as<double>(type.id()) && (rank == 1 || rank == 2);
  return numbers ? shape(id, path) : std::vector<std::uint64_t>();
}

bool Reader::has_attribute(std::string const& object, std::string const& name) const {
  return H5Aexists_by_name(file_.id(), object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

template <class T>
std::vector<T> Reader::dataset(std::string const& path, std::uint64_t columns) const {
  Handle const set = open_dataset(path);
  Handle const type(H5Dget_type(set.id()), H5Tclose, path);
  if (!readable_as<T>(type.id())) fail(path, "does not hold numbers of the expected kind");
  auto const dims = shape(set.id(), path);
  bool const fits = columns == 1 ? dims.size() == 1 : dims.size() == 2 && dims[1] == columns;
  if (!fits) fail(path, fmt::format("has not {} number{} per row", columns, columns == 1 ? "" : "s"));
  if (dims[0] > bytes_ * most_packing / columns / H5Tget_size(type.id()))
    fail(path, "claims more numbers than the file can hold");
  std::vector<T> values(dims[0] * columns);
  if (values.empty()) return values;
  if (H5Dread(set.id(), native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail(path, "cannot be read");
  return values;
}
template std::vector<float> Reader::dataset(std::string const&, std::uint64_t) const;
template std::vector<double> Reader::dataset(std::string const&, std::uint64_t) const;
template std::vector<std::int64_t> Reader::dataset(std::string const&, std::uint64_t) const;
template std::vector<std::int32_t> Reader::dataset(std::string const&, std::uint64_t) const;
template std::vector<char> Reader::dataset(std::string const&, std::uint64_t) const;

std::optional<std::uint64_t> Reader::place_of_doubles(std::string const& path) const {
  Handle const set = open_dataset(path);
  Handle const type(H5Dget_type(set.id()), H5Tclose, path), layout(H5Dget_create_plist(set.id()), H5Pclose, path);
  auto const dims = shape(set.id(), path);
  bool const plain =
      dims.size() == 1 && H5Tequal(type.id(), H5T_NATIVE_DOUBLE) > 0 && H5Pget_layout(layout.id()) == H5D_CONTIGUOUS;
  haddr_t const at = plain ? H5Dget_offset(set.id()) : HADDR_UNDEF;
  if (at == HADDR_UNDEF || at > bytes_ || dims[0] > (bytes_ - at) / sizeof(double)) return std::nullopt;
  return at;
}

Handle Reader::open_attribute(std::string const& object, std::string const& name) const {
  hid_t const id = has_attribute(object, name)
                       ? H5Aopen_by_name(file_.id(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT)
                       : -1;
  if (id < 0) fail(name, fmt::format("of {} is missing", object));
  Handle attribute(id, H5Aclose, name);
  Handle const space(H5Aget_space(attribute.id()), H5Sclose, name);
  // More values than one would be written beyond the one that is asked for.
  if (H5Sget_simple_extent_npoints(space.id()) != 1) fail(name, fmt::format("of {} is not a single value", object));
  return attribute;
}

std::string Reader::text(std::string const& object, std::string const& name) const {
  Handle const held = open_attribute(object, name);
  Handle const type(H5Aget_type(held.id()), H5Tclose, name);
  bool const is_text = H5Tget_class(type.id()) == H5T_STRING;
  bool const any_length = is_text && H5Tis_variable_str(type.id()) > 0;
  if (any_length && !sealed_) return text_of_any_length(held.id(), type.id(), object, name);
  std::size_t const size = is_text && !any_length ? H5Tget_size(type.id()) : 0;  // of any length: it is a pointer
  if (size == 0 || size > longest_text) fail(name, fmt::format("of {} is no text of fixed length", object));
  std::string value(size, '\0');
  if (H5Aread(held.id(), type.id(), value.data()) < 0) fail(name, fmt::format("of {} cannot be read", object));
  value.resize(std::min(value.find('\0'), value.size()));
  return value;
}

std::string Reader::text_of_any_length(hid_t attribute, hid_t type, std::string const& object,
                                       std::string const& name) const {
  char* read = nullptr;
  if (H5Aread(attribute, type, static_cast<void*>(&read)) < 0 || read == nullptr)
    fail(name, fmt::format("of {} cannot be read", object));
  std::string value(read);
  H5free_memory(read);
  return value;
}

template <class T>
T Reader::single(std::string const& object, std::string const& name) const {
  Handle const held = open_attribute(object, name);
  Handle const type(H5Aget_type(held.id()), H5Tclose, name);
  if (!readable_as<T>(type.id())) fail(name, fmt::format("of {} is no number of the expected kind", object));
  T value = 0;
  if (H5Aread(held.id(), native_type<T>(), &value) < 0) fail(name, fmt::format("of {} cannot be read", object));
  return value;
}

double Reader::number(std::string const& object, std::string const& name) const { return single<double>(object, name); }

std::int64_t Reader::integer(std::string const& object, std::string const& name) const {
  return single<std::int64_t>(object, name);
}

}  // namespace piola::hdf5
