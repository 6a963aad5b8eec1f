// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/draw_bodies.hpp"
#include "piola/exec/threads.hpp"
#include "piola/setup/shapes.hpp"
#include <benchmark/benchmark.h>

/// How long a picture of a bent cube takes, without reading and writing files: particles along an edge, width, height.
namespace piola {
namespace {

struct BentCube {
  ParticleSet set;
  std::vector<ReferenceMesh> meshes;
  std::vector<Point3> x;
  std::vector<double> radius, values;
  explicit BentCube(int n) {
    ShapeSpec shape;
    shape.max = {1, 1, 1};
    shape.particles = {n, n, n};
    shape.placement = ShapeSpec::Placement::cell_centred;
    fill(shape, "cube", set);
    meshes = reference_meshes(set);
    radius = ball_radii(set.volume, set.body, 3);
    for (auto const& X : set.X) {
      x.push_back({X[0] + 0.3 * X[1] * X[1], X[1], X[2] + 0.1 * X[0]});
      values.push_back(x.back()[0]);
    }
  }
};

void draw(benchmark::State& state, Appearance const& appearance, std::optional<Point3> ground = {}) {
  exec_host::set_threads(0);
  BentCube const cube(static_cast<int>(state.range(0)));
  int const width = static_cast<int>(state.range(1)), height = static_cast<int>(state.range(2));
  PictureData data{
      .points = cube.x, .radius = cube.radius, .values = cube.values, .label = {}, .unit = {}, .title = {}};
  data.body = cube.set.body;
  data.ground = ground;
  data.meshes = cube.meshes;
  View const view;
  Projection const project{view.right(), view.up(), view.towards_viewer(), 0.5 * height, 0.2 * width, 0.7 * height};
  for (auto _ : state)
    benchmark::DoNotOptimize(
        draw_bodies(data, appearance, project, {width, height, 0, width}, ColourMap(0, 1), Colour{255, 255, 255})
            .rgb.data());
}

void skin(benchmark::State& state) { draw(state, {.as = {Representation::skin}}); }
void balls(benchmark::State& state) { draw(state, {.as = {Representation::balls}}); }
void high_quality(benchmark::State& state) { draw(state, {.as = {Representation::skin}, .quality = Quality::high}); }
void on_ground(benchmark::State& state) { draw(state, {.as = {Representation::skin}}, Point3{0, 1, 0}); }
void mesh(benchmark::State& state) {
  BentCube const cube(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(reference_meshes(cube.set).data());
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Args({46, 1000, 800})->Args({100, 1600, 1200})->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(skin)->Apply(sizes);
BENCHMARK(balls)->Apply(sizes);
BENCHMARK(high_quality)->Apply(sizes);
BENCHMARK(on_ground)->Apply(sizes);
BENCHMARK(mesh)->Apply(sizes);

}  // namespace
}  // namespace piola
