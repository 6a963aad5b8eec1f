// SPDX-License-Identifier: Apache-2.0
// Whatever a sealed checkpoint holds, the reader returns a checkpoint or throws FileError. Without a seal it is refused
// before HDF5 opens it.
#include "piola/base/errors.hpp"
#include "piola/output/checkpoint.hpp"
#include "odd_file.hpp"

namespace {

using namespace piola;

void write_odd_checkpoint(fuzz::Choices& choices, std::filesystem::path const& path) {
  fuzz::OddFile file(path, choices);
  std::int64_t const layout = 4, whole = 1;
  double const number = 0.5;
  file.attribute("/", "piola_checkpoint", H5T_NATIVE_INT64, &layout);
  file.text("/", "version", "0.1.0");
  file.text("/", "machine", "v3 of a processor with v4");
  for (char const* name : {"step", "cut_to_end"}) file.attribute("/", name, H5T_NATIVE_INT64, &whole);
  for (char const* name : {"time", "dt", "first_dt"}) file.attribute("/", name, H5T_NATIVE_DOUBLE, &number);
  file.dataset("/case", H5T_NATIVE_CHAR, {5}, std::vector<char>{'a', '=', '1', '0', '\n'});
  for (char const* group : {"/state", "/observers"}) {
    if (choices.next(3) == 1) continue;
    file.group(group);
    std::string const path_of_numbers = std::string(group) + "/numbers";
    file.dataset(path_of_numbers.c_str(), H5T_NATIVE_DOUBLE, {3}, std::vector<double>{1, 2, 3});
    file.text(path_of_numbers.c_str(), "name", "numbers");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  static fuzz::ScratchFile const scratch("checkpoint.h5");
  fuzz::Choices choices(data, size);
  bool const raw = choices.next(10) == 9;
  if (raw) {
    scratch.write({reinterpret_cast<char const*>(data), size});
  } else {
    write_odd_checkpoint(choices, scratch.path());
    scratch.seal();
  }
  try {
    Checkpoint c = read_checkpoint(scratch.path());
    std::array<double, 3> numbers{};
    c.state.get("numbers", numbers);
  } catch (FileError const&) {
  }
  return 0;
}
