// SPDX-License-Identifier: Apache-2.0
#include "piola/pictures/shape_picture.hpp"
#include "piola/base/errors.hpp"
#include "piola/model/read_case.hpp"
#include "support/sample_case.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

std::string two_bodies(std::string const& first, std::string const& second) {
  std::string const rest = R"(
material = { law = "neo_hookean", density = "1100 kg/m^3", youngs_modulus = "17 MPa", poissons_ratio = 0.3 }
formulation = { name = "nodal" }
)";
  return "title = \"Two\"\n[run]\nend = \"1 ms\"\n[[body]]\nname = \"one\"\nshape = " + first + rest +
         "[[body]]\nname = \"two\"\nshape = " + second + rest;
}

std::string const tube = R"({ spacing = 0.2, capsule = { from = [4, 0], to = [5, 0], radius = 0.8 } })";
std::string const plate = R"({ box = { min = [0, 0], max = [2, 1] }, spacing = 0.1 })";

Image drawn(std::string const& text, ShapePictureOptions options) {
  ParticleSet particles;
  CaseSpec const spec = read_case_text(text, "case.toml", {}, {}, &particles);
  options.look.push_back([](PictureSpec& picture) {
    picture.width = 400;
    picture.height = 300;
  });
  return draw_shape(spec, particles, options);
}

/// How many pixels have about this hue: the channels in the same order, all far apart.
int pixels_like(Image const& image, Colour const& colour) {
  int count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      Colour const c = image.at(x, y);
      double const share = (c[0] + c[1] + c[2]) / static_cast<double>(colour[0] + colour[1] + colour[2]);
      bool same = share > 0.4 && share < 1.2;
      for (std::size_t k = 0; k < 3; ++k) same = same && std::abs(c[k] - share * colour[k]) < 6;
      count += same ? 1 : 0;
    }
  return count;
}

constexpr Colour first_colour{86, 180, 233}, second_colour{230, 159, 0}, grey{200, 203, 208};

TEST(ShapePicture, BodiesInAPlaneHaveColoursOfTheirOwn) {
  Image const image = drawn(two_bodies(plate, tube), {});
  EXPECT_GT(pixels_like(image, first_colour), 2000);
  EXPECT_GT(pixels_like(image, second_colour), 2000);
  EXPECT_LT(pixels_like(image, grey), 1000);  // edges of letters
}

TEST(ShapePicture, PatchesAreToldApartAndTheInsideIsGrey) {
  Image const image = drawn(two_bodies(plate, tube), {.patches = true});
  EXPECT_GT(pixels_like(image, grey), 3000);  // the plate, and what is inside the capsule
  EXPECT_GT(pixels_like(image, first_colour), 200);
}

TEST(ShapePicture, AViewThatIsGivenCounts) {
  std::string const text =
      two_bodies(R"({ torus = { centre = [0, 0, 0], radius = 2, tube_radius = 1 }, spacing = 0.4 })",
                 R"({ cone = { centre = [8, 0, 0], radius = 2, length = 3 }, spacing = 0.4 })");
  Image const own = drawn(text, {}), above = drawn(text, {.look = {[](PictureSpec&picture) {
                                                            picture.view = {30, 80};
                                                          }}}),
              other = drawn(text, {.look = {[](PictureSpec&picture) { picture.up = "z"; }}});
  EXPECT_NE(own.rgb, above.rgb);
  EXPECT_NE(own.rgb, other.rgb);
  EXPECT_GT(pixels_like(above, first_colour), 2000);
}

TEST(ShapePicture, PatchesOfCasesWithoutAnyAreRefused) {
  EXPECT_THROW(drawn(test::sample_case(), {.patches = true}), InputError);
  EXPECT_GT(pixels_like(drawn(test::sample_case(), {}), first_colour), 2000);
}

}  // namespace
}  // namespace piola
