// SPDX-License-Identifier: Apache-2.0
// Whatever a sealed frame holds, the reader returns a frame that can be drawn, or throws FileError or InputError; as a
// cloud of points it is read or refused in words.
#include "piola/base/errors.hpp"
#include "piola/drawing/picture.hpp"
#include "piola/output/frame_reader.hpp"
#include "piola/setup/cloud_file.hpp"
#include "odd_file.hpp"
#include <algorithm>
#include <limits>

namespace {

using namespace piola;

constexpr hsize_t particles = 4;

void write_frame(fuzz::Choices& choices, std::filesystem::path const& path) {
  constexpr std::array<float, 8> values{1,
                                        0,
                                        -1,
                                        std::numeric_limits<float>::quiet_NaN(),
                                        std::numeric_limits<float>::infinity(),
                                        std::numeric_limits<float>::max(),
                                        std::numeric_limits<float>::lowest(),
                                        std::numeric_limits<float>::denorm_min()};
  fuzz::OddFile file(path, choices);
  std::int64_t const dimension = 3 - static_cast<std::int64_t>(choices.next(60));
  file.group("/VTKHDF/PointData");
  file.attribute("/", "dimension", H5T_NATIVE_INT64, &dimension);
  std::vector<float> points, numbers;
  for (unsigned i = 0; i < 3 * particles; ++i) points.push_back(static_cast<float>(i) + values[choices.next(8)]);
  for (unsigned i = 0; i < 2 * particles; ++i) numbers.push_back(values[choices.next(8)]);
  file.dataset("/VTKHDF/Points", H5T_NATIVE_FLOAT, {particles, 3}, points);
  file.dataset("/VTKHDF/PointData/Pressure", H5T_NATIVE_FLOAT, {particles}, numbers);
  file.text("/VTKHDF/PointData/Pressure", "unit", "Pa");
  file.dataset("/VTKHDF/PointData/Volume", H5T_NATIVE_FLOAT, {particles},
               std::vector<float>(numbers.begin() + particles, numbers.end()));
  file.dataset("/VTKHDF/PointData/Body", H5T_NATIVE_INT64, {particles}, std::vector<std::int64_t>{0, -1, 7, 1LL << 40});
  file.dataset("/VTKHDF/FieldData/TimeValue", H5T_NATIVE_DOUBLE, {1}, std::vector<double>{0.5});
}

void draw(FrameReader const& frame) {
  auto const points = frame.positions();
  auto const body = frame.bodies();
  auto const volume = frame.volumes(), stored = frame.values("Pressure");
  FieldInfo const info = frame.info("Pressure");
  auto const radii = ball_radii(std::vector<double>(volume.begin(), volume.end()), body, frame.dimension());
  auto const values = picture_values(std::vector<double>(stored.begin(), stored.end()), info.components);
  PictureStyle const style{200, 200, {30, 20}, {}};
  Window window;
  window.include(style.view, points, radii.empty() ? 0 : *std::max_element(radii.begin(), radii.end()));
  PictureData const data{points,    radii,  values,       picture_label("Pressure", info.components),
                         info.unit, "fuzz", frame.time(), frame.dimension()};
  draw_picture(data, style, window);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  static fuzz::ScratchFile const scratch("frame.hdf");
  fuzz::Choices choices(data, size);
  bool const raw = choices.next(10) == 9;
  if (raw) {
    scratch.write({reinterpret_cast<char const*>(data), size});
  } else {
    write_frame(choices, scratch.path());
    scratch.seal();
  }
  try {
    draw(FrameReader(scratch.path()));
  } catch (FileError const&) {
  } catch (InputError const&) {
  }
  std::vector<std::string> problems;
  read_cloud(scratch.path().string(), {}, problems);
  return 0;
}
