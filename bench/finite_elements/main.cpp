// SPDX-License-Identifier: Apache-2.0
// Explicit finite elements: where references of `piola verify` come from. See README.md beside this file.
#include "bricks.hpp"
#include "problems.hpp"
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#ifdef _OPENMP
#include <omp.h>
#endif

namespace {

using namespace bricks;

struct Options {
  std::string problem;
  std::vector<std::ptrdiff_t> across;
  std::optional<double> poissons_ratio;
  double safety = 0.9;  ///< of the step, in parts of the limit
  int threads = 1;
  bool time = false;
};

struct Curve {
  std::vector<double> time, value;
};

struct Outcome {
  std::vector<Curve> curves;
  std::ptrdiff_t steps = 0;
  double energy_error = 0;  ///< largest |change| without a moving support, in parts of the energy at the start
  double seconds = 0, processor_seconds = 0, bricks = 0;
};

/// Makes an angle continuous: no more than half a turn from what it was before.
void unwrap(double before, double& angle) {
  constexpr double turn = 2 * std::numbers::pi;
  angle += turn * std::round((before - angle) / turn);
}

/// Advances by central differences with lumped masses: forces at x(n), velocities half a step apart.
class Run {
 public:
  Run(Problem const& problem, Options const& options, std::ptrdiff_t across)
      : problem_(problem),
        options_(options),
        mesh_(problem.box, problem.cells(across), problem.material.density),
        bricks_(problem.material, mesh_) {
    hold(problem.held);
    each([&](std::size_t n, std::array<double, 3> const& X) {
      auto const v = problem.velocity(X), u = problem.displacement ? problem.displacement(X) : std::array<double, 3>{};
      for (std::size_t c = 0; c < 3; ++c) {
        mesh_.x[c][n] += u[c];
        mesh_.v[c][n] = support_velocity(n, c, v[c]);
        driven_ = driven_ || (mesh_.mobility[c][n] == 0 && mesh_.v[c][n] != 0);
      }
    });
  }

  Outcome go() {
    Outcome out;
    out.bricks = static_cast<double>(mesh_.cells[0] * mesh_.cells[1] * mesh_.cells[2]);
    auto const begin = std::chrono::steady_clock::now();
    std::clock_t const processor_begin = std::clock();
    record(out, problem_.trace(mesh_), 0);
    bool first = true;
    double dt = 0, before = 0;
    while (time_ < problem_.end * (1 - 1e-12)) {
      bool const watch = out.steps % looks == 0;
      Watch const seen = watch ? bricks_.add_forces<true>(mesh_) : bricks_.add_forces<false>(mesh_);
      if (watch) dt = options_.safety * 2 / std::sqrt(seen.frequency2);
      if (watch && !std::isfinite(seen.energy))
        throw std::runtime_error("the mesh collapsed: a brick has no volume left");
      double const step = std::min(dt, problem_.end - time_);
      double const kicked = (first ? 0.0 : 0.5 * before) + 0.5 * step;
      if (watch) judge(out, seen.energy + kinetic_energy(kicked));
      kick(kicked);
      advance(out, step);
      before = step;
      first = false;
      ++out.steps;
    }
    out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    out.processor_seconds = static_cast<double>(std::clock() - processor_begin) / CLOCKS_PER_SEC;
    return out;
  }

 private:
  static constexpr std::ptrdiff_t looks = 10;  ///< steps between looks at energy and at the limit of the step

  template <class Do>
  void each(Do const& act) {
    mesh_.for_each_node([&](std::size_t n, std::array<std::ptrdiff_t, 3> const& at) {
      act(n, std::array{mesh_.place(at[0], 0), mesh_.place(at[1], 1), mesh_.place(at[2], 2)});
    });
  }
  void hold(std::function<unsigned(std::array<double, 3> const&)> const& held) {
    each([&](std::size_t n, std::array<double, 3> const& X) {
      unsigned const bits = held(X);
      for (std::size_t c = 0; c < 3; ++c) mesh_.mobility[c][n] = (bits >> c & 1U) != 0 ? 0 : 1 / mesh_.mass[n];
    });
  }
  /// A held component keeps the velocity of its support: none, unless the whole node is driven.
  double support_velocity(std::size_t n, std::size_t c, double velocity) const {
    bool const driven = mesh_.mobility[0][n] == 0 && mesh_.mobility[1][n] == 0 && mesh_.mobility[2][n] == 0;
    return mesh_.mobility[c][n] == 0 && !driven ? 0 : velocity;
  }

  /// v += dt f / m.
  void kick(double dt) {
    for (std::size_t c = 0; c < 3; ++c) {
      double *const v = &mesh_.v[c][0], *const f = &mesh_.f[c][0];
      double const* const mobility = &mesh_.mobility[c][0];
      std::ptrdiff_t const size = mesh_.size;
#pragma omp parallel for simd schedule(static)
      for (std::ptrdiff_t n = 0; n < size; ++n) {
        v[n] += dt * mobility[n] * f[n];
        f[n] = 0;
      }
    }
  }
  /// The kinetic energy m v(n - 1/2) . v(n + 1/2) / 2 that central differences keep, of a kick to come. Not by lanes:
  /// clang 14 loses a part of such a sum at -O1.
  double kinetic_energy(double dt) const {
    double kinetic = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      double const *const v = &mesh_.v[c][0], *const f = &mesh_.f[c][0];
      double const *const mobility = &mesh_.mobility[c][0], *const mass = &mesh_.mass[0];
      std::ptrdiff_t const size = mesh_.size;
#pragma omp parallel for schedule(static) reduction(+ : kinetic)
      for (std::ptrdiff_t n = 0; n < size; ++n) kinetic += 0.5 * mass[n] * v[n] * (v[n] + dt * mobility[n] * f[n]);
    }
    return kinetic;
  }
  void drift(double dt) {
    for (std::size_t c = 0; c < 3; ++c) {
      double *const x = &mesh_.x[c][0], *const v = &mesh_.v[c][0];
      std::ptrdiff_t const size = mesh_.size;
#pragma omp parallel for simd schedule(static)
      for (std::ptrdiff_t n = 0; n < size; ++n) x[n] += dt * v[n];
    }
  }

  void judge(Outcome& out, double energy) {
    if (out.steps == 0) start_ = energy;
    if (driven_) return;
    out.energy_error = std::max(out.energy_error, std::abs(energy / start_ - 1));
  }
  /// One step of the nodes, and the samples that lie in it, linear between its ends.
  void advance(Outcome& out, double step) {
    auto const next = [&] { return problem_.sample * static_cast<double>(out.curves[0].time.size()); };
    double const after = time_ + step * (1 + 1e-9);
    bool const sampled = next() <= after;
    auto const before = sampled ? problem_.trace(mesh_) : std::vector<double>();
    drift(step);
    if (sampled) {
      auto now = problem_.trace(mesh_);
      if (problem_.angle) unwrap(before[0], now[0]);
      for (double at = next(); at <= after; at = next()) {
        std::vector<double> between;
        for (std::size_t k = 0; k < now.size(); ++k)
          between.push_back(before[k] + (at - time_) / step * (now[k] - before[k]));
        record(out, between, at);
      }
    }
    time_ += step;
  }
  void record(Outcome& out, std::vector<double> const& values, double time) const {
    out.curves.resize(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
      out.curves[k].time.push_back(time);
      out.curves[k].value.push_back(values[k]);
    }
  }

  Problem const& problem_;
  Options const& options_;
  Mesh mesh_;
  Bricks bricks_;
  double time_ = 0, start_ = 0;
  bool driven_ = false;  ///< a support does work
};

/// Vertex of the parabola through three samples around k.
std::array<double, 2> vertex(Curve const& c, std::size_t k) {
  double const *const t = &c.time[k - 1], *const y = &c.value[k - 1];
  double const left = (y[1] - y[0]) / (t[1] - t[0]), right = (y[2] - y[1]) / (t[2] - t[1]);
  double const curvature = (right - left) / (t[2] - t[0]), slope = left + curvature * (t[1] - t[0]);
  double const shift = curvature == 0 ? 0 : -slope / (2 * curvature);
  return {t[1] + shift, y[1] + slope * shift + curvature * shift * shift};
}

double read_off(Reading const& reading, Curve const& c) {
  auto const& y = c.value;
  if (reading.take == Statistic::at_time) {
    auto const after = std::lower_bound(c.time.begin(), c.time.end(), reading.time * (1 - 1e-12));
    auto const k = static_cast<std::size_t>(after - c.time.begin());
    if (k == 0 || k == y.size()) throw std::runtime_error(reading.name + ": the run is too short");
    double const share = (reading.time - c.time[k - 1]) / (c.time[k] - c.time[k - 1]);
    return (y[k - 1] + share * (y[k] - y[k - 1])) / reading.scale;
  }
  std::size_t at = 0;
  if (reading.take == Statistic::first_peak || reading.take == Statistic::time_of_first_peak) {
    double largest = 0;
    for (double const value : y) largest = std::max(largest, std::abs(value));
    for (std::size_t k = 1; k + 1 < y.size() && at == 0; ++k) {
      double const here = std::abs(y[k]);
      if (here >= std::abs(y[k - 1]) && here > std::abs(y[k + 1]) && here > 0.5 * largest) at = k;
    }
  } else {
    auto const place = std::max_element(y.begin(), y.end());
    at = static_cast<std::size_t>(place - y.begin());
  }
  if (at == 0 || at + 1 == y.size()) throw std::runtime_error(reading.name + ": the run holds no peak");
  bool const time = reading.take == Statistic::time_of_first_peak || reading.take == Statistic::time_of_largest;
  return vertex(c, at)[time ? 0 : 1] / reading.scale;
}

/// Order and limit of q(h) = limit + c h^order from the three finest; nothing where they do not converge like that.
std::optional<std::array<double, 2>> richardson(std::vector<std::ptrdiff_t> const& across,
                                                std::vector<double> const& q) {
  std::size_t const n = q.size();
  if (n < 3) return std::nullopt;
  auto const power = [&](std::size_t back, double order) {
    return std::pow(static_cast<double>(across[n - 1]) / static_cast<double>(across[n - back]), order);
  };
  double const ratio = (q[n - 3] - q[n - 2]) / (q[n - 2] - q[n - 1]);
  auto const of = [&](double order) { return (power(3, order) - power(2, order)) / (power(2, order) - 1); };
  double low = 0.2, high = 6;
  if (!(ratio > of(low) && ratio < of(high))) return std::nullopt;
  for (int k = 0; k < 60; ++k) (of((low + high) / 2) < ratio ? low : high) = (low + high) / 2;
  return std::array{low, q[n - 1] + (q[n - 1] - q[n - 2]) / (power(2, low) - 1)};
}

void print_head(Problem const& problem, Options const& options) {
  std::printf("%s, nu = %g\n%8s %9s %7s", problem.about.c_str(), problem.material.poissons_ratio, "across", "bricks",
              "steps");
  for (Reading const& r : problem.readings) std::printf("  %s [%s]", r.name.c_str(), r.unit.c_str());
  std::printf("  energy error");
  if (options.time) std::printf("  seconds  million brick-steps/s  per cpu s");
  std::printf("\n");
}

void print_run(Problem const& problem, Options const& options, std::ptrdiff_t across, Outcome const& run,
               std::vector<double> const& values) {
  std::printf("%8td %9.0f %7td", across, run.bricks, run.steps);
  for (std::size_t k = 0; k < values.size(); ++k) {
    auto const& r = problem.readings[k];
    std::printf("  %*.5f", static_cast<int>(r.name.size() + r.unit.size() + 3), values[k]);
  }
  std::printf("  %12.1e", run.energy_error);
  double const work = run.bricks * static_cast<double>(run.steps) / 1e6;
  if (options.time)
    std::printf("  %7.2f  %21.2f  %9.2f", run.seconds, work / run.seconds, work / run.processor_seconds);
  std::printf("\n");
  std::fflush(stdout);
}

void study(Problem const& problem, Options const& options) {
  std::vector<std::vector<double>> values(problem.readings.size());
  print_head(problem, options);
  for (std::ptrdiff_t const across : options.across) {
    auto const cells = problem.cells(across);
    if (*std::min_element(cells.begin(), cells.end()) < 1)
      throw std::runtime_error("--across: " + std::to_string(across) + " leaves a side without a brick - give more");
    Outcome run = Run(problem, options, across).go();
    if (problem.angle) {
      auto& angle = run.curves[0].value;
      for (std::size_t k = 1; k < angle.size(); ++k) unwrap(angle[k - 1], angle[k]);
    }
    std::vector<double> row;
    for (std::size_t k = 0; k < values.size(); ++k) {
      Reading const& reading = problem.readings[k];
      row.push_back(read_off(reading, run.curves[reading.traced]));
      values[k].push_back(row.back());
    }
    print_run(problem, options, across, run, row);
  }
  for (std::size_t k = 0; k < values.size(); ++k) {
    auto const found = richardson(options.across, values[k]);
    if (found) {
      std::printf("%s: order %.2f, limit %.5f %s\n", problem.readings[k].name.c_str(), (*found)[0], (*found)[1],
                  problem.readings[k].unit.c_str());
    } else if (options.across.size() >= 3) {
      auto const [low, high] = std::minmax_element(values[k].end() - 3, values[k].end());
      std::printf("%s: no clear order, the three finest within %.5f to %.5f %s\n", problem.readings[k].name.c_str(),
                  *low, *high, problem.readings[k].unit.c_str());
    }
  }
}

std::vector<std::ptrdiff_t> numbers_in(std::string const& text) {
  std::vector<std::ptrdiff_t> list;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) list.push_back(std::stol(part));
  if (list.empty() || !std::is_sorted(list.begin(), list.end()) || list.front() < 1)
    throw std::runtime_error("--across: wants rising numbers of bricks, such as 4,8,16");
  return list;
}

Options options_in(int count, char** words) {
  Options o;
  o.problem = count > 1 ? words[1] : "";
  for (int k = 2; k < count; ++k) {
    std::string const word = words[k];
    if (word == "--time") {
      o.time = true;
      continue;
    }
    if (k + 1 == count) throw std::runtime_error(word + ": wants a value");
    std::string const value = words[++k];
    if (word == "--across")
      o.across = numbers_in(value);
    else if (word == "--nu")
      o.poissons_ratio = std::stod(value);
    else if (word == "--safety")
      o.safety = std::stod(value);
    else if (word == "--threads")
      o.threads = std::stoi(value);
    else
      throw std::runtime_error(word + ": is not known (known: --across, --nu, --safety, --threads, --time)");
  }
  if (o.across.empty()) o.across = {4, 8, 16};
  return o;
}

}  // namespace

int main(int count, char** words) {
  try {
    Options const options = options_in(count, words);
#ifdef _OPENMP
    omp_set_num_threads(options.threads);
#endif
    for (Problem problem : problems()) {
      if (problem.name != options.problem) continue;
      if (options.poissons_ratio) problem.material.poissons_ratio = *options.poissons_ratio;
      study(problem, options);
      return 0;
    }
    std::printf(
        "usage: piola_finite_elements PROBLEM [--across 4,8,16] [--nu NU] [--safety 0.9] [--threads 1] [--time]\n");
    for (Problem const& problem : problems()) std::printf("  %-16s%s\n", problem.name.c_str(), problem.about.c_str());
    return 2;
  } catch (std::exception const& error) {
    std::fprintf(stderr, "piola_finite_elements: %s\n", error.what());
    return 1;
  }
}
