// SPDX-License-Identifier: Apache-2.0
#include "piola/output/hdf5_driver.hpp"
#include "piola/base/errors.hpp"
#include "piola/output/hdf5_types.hpp"
#include <algorithm>
#include <iterator>

#if __has_include(<H5FDdevelop.h>)  // from HDF5 1.13 on what drivers need has a header of its own
#include <H5FDdevelop.h>
#endif

namespace piola::hdf5 {
namespace {

constexpr haddr_t most_bytes = (haddr_t{1} << 62) - 1;

/// An open file in the format that HDF5 requires of drivers.
struct Open : H5FD_t {
  AppendOnlyFile* file;
  haddr_t end;  ///< of what is allocated
};

Open& open_of(H5FD_t* file) { return static_cast<Open&>(*file); }
Open const& open_of(H5FD_t const* file) { return static_cast<Open const&>(*file); }

H5FD_t* open(char const*, unsigned, hid_t access, haddr_t) {
  auto const* file = static_cast<AppendOnlyFile* const*>(H5Pget_driver_info(access));
  return file == nullptr ? nullptr : new Open{{}, *file, 0};
}

herr_t close(H5FD_t* file) {
  open_of(file).file->bytes = open_of(file).end;
  delete &open_of(file);
  return 0;
}

herr_t query(H5FD_t const*, unsigned long* features) {
  // Small pieces of its own HDF5 collects before it writes them.
  *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t end_of_allocated(H5FD_t const* file, H5FD_mem_t) { return open_of(file).end; }

herr_t set_end(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  open_of(file).end = end;
  return 0;
}

herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, void* to) {
  open_of(file).file->on_disk.read(at, {static_cast<std::byte*>(to), size});
  return 0;
}

herr_t write(H5FD_t* file, H5FD_mem_t type, hid_t, haddr_t at, std::size_t size, void const* from) {
  AppendOnlyFile& to = *open_of(file).file;
  if (to.reserving && type == H5FD_MEM_DRAW) {
    to.reserved = at;
    return 0;
  }
  to.on_disk.write(at, {static_cast<std::byte const*>(from), size});
  return 0;
}

H5FD_class_t driver() {
  H5FD_class_t d{};
#ifdef H5FD_CLASS_VERSION
  d.version = H5FD_CLASS_VERSION;
  d.value = static_cast<H5FD_class_value_t>(600);  // in the range for unregistered drivers
#endif
  d.name = "piola";
  d.maxaddr = most_bytes;
  d.fc_degree = H5F_CLOSE_STRONG;  // what is left open must not keep the file
  d.fapl_size = sizeof(AppendOnlyFile*);
  d.open = open;
  d.close = close;
  d.query = query;
  d.get_eoa = end_of_allocated;
  d.set_eoa = set_end;
  d.get_eof = end_of_allocated;
  d.read = read;
  d.write = write;
  constexpr H5FD_mem_t map[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(map), std::end(map), d.fl_map);
  return d;
}

}  // namespace

Handle create_on(AppendOnlyFile& file) {
  disable_error_stack();
  static H5FD_class_t const ours = driver();
  static hid_t const registered = H5FDregister(&ours);
  Handle const access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "a property list");
  AppendOnlyFile* const info = &file;
  if (registered < 0 || H5Pset_driver(access.id(), registered, static_cast<void const*>(&info)) < 0)
    throw FileError("HDF5 cannot use the driver of the program - this is a defect of the program, please report it");
  // Ranks write whole pages of large data sets, which no two of them have in common.
  constexpr hsize_t page = 4096;
  if (H5Pset_alignment(access.id(), page, page) < 0)
    throw FileError("HDF5 cannot align data sets - this is a defect of the program, please report it");
  // The name is not used: the driver holds the file.
  return {H5Fcreate("piola", H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose, "a file"};
}

}  // namespace piola::hdf5
