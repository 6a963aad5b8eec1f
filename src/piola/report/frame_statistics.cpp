// SPDX-License-Identifier: Apache-2.0
#include "piola/report/frame_statistics.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/drawing/picture.hpp"
#include "piola/drawing/revolution.hpp"
#include "piola/formulations/field_signs.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace piola::report {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t most_bodies = 65536;

/// Values from which quantiles are taken: evenly chosen ones, so that memory stays small.
class Sample {
 public:
  explicit Sample(std::size_t frames)
      : per_frame_(std::max<std::size_t>(1000, 400'000 / std::max<std::size_t>(frames, 1))) {}
  template <class Value>
  void take(std::size_t count, Value const& value) {
    std::size_t const stride = count / per_frame_ + 1;
    for (std::size_t i = 0; i < count; i += stride)
      if (double const v = value(i); std::isfinite(v)) values_.push_back(v);
  }
  double quantile(double fraction) {
    if (values_.empty()) return 0;
    auto const at = values_.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values_.size() - 1));
    std::nth_element(values_.begin(), at, values_.end());
    return *at;
  }

 private:
  std::size_t per_frame_;
  std::vector<double> values_;
};

/// The range of one number over all frames.
struct Extent {
  explicit Extent(std::size_t frames) : sample(frames) {}
  double low = infinity, high = -infinity;
  Sample sample;
  std::array<double, 2> include(std::size_t count, auto const& value) {
    double least = infinity, most = -infinity;
    for (std::size_t i = 0; i < count; ++i) {
      double const v = value(i);
      if (!std::isfinite(v)) continue;
      least = std::min(least, v);
      most = std::max(most, v);
    }
    low = std::min(low, least);
    high = std::max(high, most);
    sample.take(count, value);
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return least <= most ? std::array{least, most} : std::array{none, none};
  }
};

/// The ends of a field's colours; where half a per cent at each side leaves nothing between, its least and largest.
ByteScale scale_of_values(Extent& extent) {
  if (!(extent.low <= extent.high)) return {};
  ByteScale const scale{extent.sample.quantile(0.005), extent.sample.quantile(0.995)};
  return scale.low < scale.high ? scale : ByteScale{extent.low, extent.high};
}

/// The ends of an axis: the range of all particles, unless a few outliers would make the rest too small to see.
std::array<double, 2> ends_of_axis(Extent& extent) {
  if (!(extent.low <= extent.high)) return {0, 0};
  constexpr double far = 5;  // times the box of all but one per mille
  double const low = extent.sample.quantile(0.0005), high = extent.sample.quantile(0.9995);
  double const air = high - low;
  if (extent.high - extent.low <= far * air || air == 0) return {extent.low, extent.high};
  return {std::max(extent.low, low - air / 2), std::min(extent.high, high + air / 2)};
}

/// The bodies of half sections and the radii of their balls.
void read_sections(FrameReader const& frame, FrameStatistics& statistics) {
  auto const body = frame.bodies();
  auto const stored = frame.volumes();
  std::vector<double> const volume(stored.begin(), stored.end());
  auto const radii = ball_radii_of_rings(volume, frame.positions(), body);
  for (std::size_t i = 0; i < body.size(); ++i) {
    auto const b = static_cast<std::size_t>(std::clamp<double>(body[i], 0, most_bodies - 1));
    statistics.body.push_back(static_cast<std::uint16_t>(b));
    if (b >= statistics.radius.size()) statistics.radius.resize(b + 1);
    statistics.radius[b] = radii[i];
  }
}

void read_bodies(FrameReader const& frame, FrameStatistics& statistics) {
  auto const body = frame.bodies();
  auto const volume = frame.volumes();
  if (frame.axisymmetric()) return read_sections(frame, statistics);
  std::vector<double> largest;
  for (std::size_t i = 0; i < body.size(); ++i) {
    auto const b = static_cast<std::size_t>(std::clamp<double>(body[i], 0, most_bodies - 1));
    statistics.body.push_back(static_cast<std::uint16_t>(b));
    if (b >= largest.size()) largest.resize(b + 1);
    largest[b] = std::max(largest[b], static_cast<double>(volume[i]));
  }
  std::vector<int> numbers(largest.size());
  for (std::size_t b = 0; b < numbers.size(); ++b) numbers[b] = static_cast<int>(b);
  statistics.radius = ball_radii(largest, numbers, statistics.dimension);
}

std::string label_of(FieldInfo const& info) {
  return info.name == "CauchyStress" ? "von Mises stress" : picture_label(info.name, info.components);
}

/// The data of the first frame alone. Throws InputError for fields that it does not have.
FrameStatistics statistics_of(FrameReader const& first, std::vector<std::string> const& fields) {
  FrameStatistics statistics{.dimension = first.dimension(), .particles = first.particles()};
  for (std::string const& name : fields)
    statistics.fields.push_back({first.info(name), label_of(first.info(name)), {}, {}});
  statistics.axisymmetric = first.axisymmetric();
  read_bodies(first, statistics);
  return statistics;
}

/// Particles that are not inside the box, in the frame with most of them.
std::size_t count_outside(std::vector<float> const& points, FrameStatistics const& statistics) {
  std::size_t count = 0;
  for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
    bool inside = true;
    for (std::size_t c = 0; c < 3; ++c) {
      auto const x = static_cast<double>(points[i + c]);
      inside = inside && x >= statistics.low[c] && x <= statistics.high[c];
    }
    count += inside ? 0 : 1;
  }
  return count;
}

}  // namespace

std::vector<std::size_t> spread(std::size_t count, std::size_t wanted) {
  wanted = std::min(std::max<std::size_t>(wanted, 1), count);
  std::vector<std::size_t> numbers;
  for (std::size_t k = 0; k < wanted; ++k)
    numbers.push_back(wanted == 1 ? count - 1 : (k * (count - 1) + (wanted - 1) / 2) / (wanted - 1));
  return numbers;
}

std::vector<std::string> usual_fields(FrameReader const& frame, std::string const& first, std::size_t most) {
  auto const known = frame.fields();
  std::vector<std::string> order{first,          "VonMisesStress", "EquivalentPlasticStrain",
                                 "Pressure",     "Damage",         "Velocity",
                                 "CauchyStress", "Temperature",    "Displacement"};
  order.insert(order.end(), known.begin(), known.end());
  std::vector<std::string> chosen;
  auto const holds = [](std::vector<std::string> const& list, std::string const& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  for (std::string const& name : order) {
    bool const plain = name == "Id" || name == "Body" || name == "Volume" || holds(chosen, name);
    bool const twice = name == "CauchyStress" && holds(chosen, "VonMisesStress");
    if (chosen.size() < most && frame.knows(name) && !plain && !twice && frame.info(name).components != 9)
      chosen.push_back(name);
  }
  return chosen;
}

std::vector<float> shown_values(FrameReader const& frame, FieldInfo const& info) {
  auto values = frame.values(info.name);
  if (info.components == 1) return values;
  auto const width = static_cast<std::size_t>(info.components);
  std::vector<float> shown;
  shown.reserve(values.size() / width);
  std::vector<double> some;
  constexpr std::size_t at_a_time = 4096;
  for (std::size_t from = 0; from < values.size(); from += at_a_time * width) {
    auto const end = std::min(values.size(), from + at_a_time * width);
    some.assign(values.begin() + static_cast<std::ptrdiff_t>(from), values.begin() + static_cast<std::ptrdiff_t>(end));
    for (double const v : picture_values(some, info.components)) shown.push_back(static_cast<float>(v));
  }
  return shown;
}

FrameStatistics read_statistics(RunFolder const& run, std::vector<std::size_t> const& frames,
                                std::vector<std::string> const& fields) {
  PIOLA_EXPECTS(!frames.empty() && frames.back() < run.frames.size());
  FrameStatistics statistics = statistics_of(FrameReader(run.frames[frames.front()].second), fields);
  statistics.frames = frames;
  std::vector<Extent> axes(3, Extent(frames.size())), ranges(fields.size(), Extent(frames.size()));
  for (std::size_t const k : frames) {
    FrameReader const frame(run.frames[k].second);
    statistics.times.push_back(frame.time());
    statistics.rigid_poses.push_back(frame.rigid_poses());
    auto const points = frame.points();
    if (points.size() != 3 * statistics.particles)
      throw FileError(fmt::format("{}: has other particles than the first frame - it belongs to another run",
                                  run.frames[k].second.string()));
    for (std::size_t c = 0; c < 3; ++c) {
      auto const ends =
          axes[c].include(statistics.particles, [&](std::size_t i) { return static_cast<double>(points[3 * i + c]); });
      if (k == frames.front()) statistics.first_low[c] = ends[0], statistics.first_high[c] = ends[1];
    }
    for (std::size_t f = 0; f < fields.size(); ++f) {
      auto const values = shown_values(frame, statistics.fields[f].info);
      statistics.fields[f].extremes.push_back(
          ranges[f].include(values.size(), [&](std::size_t i) { return static_cast<double>(values[i]); }));
    }
  }
  for (std::size_t f = 0; f < fields.size(); ++f) {
    auto const whole = whole_range(fields[f]);
    statistics.fields[f].scale = whole ? ByteScale{(*whole)[0], (*whole)[1]} : scale_of_values(ranges[f]);
  }
  bool cut = false;
  for (std::size_t c = 0; c < 3; ++c) {
    auto const ends = ends_of_axis(axes[c]);
    statistics.low[c] = ends[0], statistics.high[c] = ends[1];
    cut = cut || ends[0] > axes[c].low || ends[1] < axes[c].high;
  }
  for (std::size_t const k : cut ? frames : std::vector<std::size_t>{frames.back()})
    statistics.outside =
        std::max(statistics.outside, count_outside(FrameReader(run.frames[k].second).points(), statistics));
  return statistics;
}

FrameCodes codes_of(FrameReader const& frame, FrameStatistics const& statistics, Lattice const& lattice,
                    std::size_t fields, std::size_t every) {
  PIOLA_EXPECTS(every >= 1 && fields <= statistics.fields.size());
  FrameCodes codes;
  {
    auto const points = frame.points();
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; 3 * i < points.size(); i += every)
        codes.x[c].push_back(lattice.code(static_cast<double>(points[3 * i + c]), c));
  }
  for (std::size_t f = 0; f < fields; ++f) {
    auto& list = codes.fields.emplace_back();
    auto const values = shown_values(frame, statistics.fields[f].info);
    for (std::size_t i = 0; i < values.size(); i += every)
      list.push_back(statistics.fields[f].scale.code(static_cast<double>(values[i])));
  }
  return codes;
}

}  // namespace piola::report
