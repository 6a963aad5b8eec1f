// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <hdf5.h>

/// Types common to writing and reading of HDF5 files. Included by output/hdf5*.cpp only.
namespace piola::hdf5 {

/// The type of HDF5 for a number in memory.
template <class T>
hid_t native_type();
template <>
inline hid_t native_type<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
inline hid_t native_type<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
inline hid_t native_type<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
inline hid_t native_type<std::int32_t>() {
  return H5T_NATIVE_INT32;
}
template <>
inline hid_t native_type<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}
template <>
inline hid_t native_type<char>() {
  return H5T_NATIVE_CHAR;
}

/// HDF5 would print its own stack of errors; ours are exceptions.
inline void disable_error_stack() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

}  // namespace piola::hdf5
