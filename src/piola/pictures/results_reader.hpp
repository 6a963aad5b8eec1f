// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/picture.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/observers/results_folder.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/output/frames.hpp"
#include "piola/pictures/case_scene.hpp"
#include "piola/pictures/rigid_history.hpp"
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace piola {

inline constexpr std::uint64_t most_summary_bytes = 100'000'000;

/// The title of a run; without a summary, the name of its folder.
inline std::string title_of_run(std::filesystem::path const& folder) {
  if (!std::filesystem::exists(folder / "summary.json")) return folder.filename().string();
  auto const summary =
      nlohmann::json::parse(read_text_file(folder / "summary.json", most_summary_bytes), nullptr, false);
  bool const titled = summary.is_object() && summary.contains("title") && summary["title"].is_string();
  return titled ? summary["title"].get<std::string>() : folder.filename().string();
}

/// A frame and its picture data.
struct Shot {
  Frame frame;
  std::vector<double> radii, values;
  std::vector<RigidShape> shapes;
  std::vector<std::uint8_t> loose;
  std::vector<std::array<double, 3>> points = {};  ///< positions with magnified displacements
  PictureData data = {};  ///< refers to the vectors above, whose buffers keep their address when a shot is moved
  Window window = {};
};

/// Common data of the pictures of one run, for any field.
struct RunInFolder {
  std::string title;
  ParticleSet particles;  ///< of the case
  std::optional<CaseSpec> spec;
  std::vector<ReferenceMesh> meshes;
  std::vector<std::uint8_t> held;      ///< by supports
  std::optional<RigidHistory> rigids;  ///< if there is a case
  std::vector<std::pair<double, std::filesystem::path>> frames;

  explicit RunInFolder(std::filesystem::path const& folder)
      : title(title_of_run(folder)), spec(case_in_results(folder, &particles)), frames(list_frames(folder)) {
    if (!spec) return;
    meshes = reference_meshes(particles);
    held = held_particles(*spec, particles);
    rigids.emplace(folder / "history.csv", spec->rigids);
  }
  /// Whether a frame belongs to the present case in the folder.
  bool has(Frame const& frame) const {
    return frame.points.size() == particles.X.size() && frame.dimension == particles.dimension &&
           std::equal(frame.body.begin(), frame.body.end(), particles.body.begin(), particles.body.end());
  }
  std::vector<RigidShape> shapes_of(Frame const& frame) const {
    if (!spec) return {};
    return shapes_at(spec->rigids, frame.time, rigids->at(frame.time));
  }
};

}  // namespace piola
