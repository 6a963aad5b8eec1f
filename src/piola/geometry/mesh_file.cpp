// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/mesh_file.hpp"
#include "piola/base/byte_stream.hpp"
#include "piola/base/child_process.hpp"
#include "piola/base/text.hpp"
#include "piola/geometry/mesh_bytes.hpp"
#include "piola/geometry/mesh_polygon.hpp"
#include <algorithm>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <span>

namespace piola::geometry {

namespace {

class BytesStream : public Assimp::IOStream {
 public:
  explicit BytesStream(std::string_view bytes) : bytes_(bytes) {}
  std::size_t Read(void* buffer, std::size_t size, std::size_t count) override {
    if (size == 0) return 0;
    std::size_t const whole = std::min(count, (bytes_.size() - at_) / size);
    if (whole > 0) std::memcpy(buffer, bytes_.data() + at_, whole * size);
    at_ += whole * size;
    return whole;
  }
  std::size_t Write(void const*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    std::size_t const start = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : bytes_.size();
    if (start + offset > bytes_.size()) return aiReturn_FAILURE;
    at_ = start + offset;
    return aiReturn_SUCCESS;
  }
  std::size_t Tell() const override { return at_; }
  std::size_t FileSize() const override { return bytes_.size(); }
  void Flush() override {}

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

/// Lets the reader see one file. What else a mesh names (libraries of materials) is never opened.
class OneFile : public Assimp::IOSystem {
 public:
  OneFile(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}
  bool Exists(char const* name) const override { return name == name_; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(char const* name, char const*) override {
    return name == name_ ? std::make_unique<BytesStream>(bytes_).release() : nullptr;
  }
  void Close(Assimp::IOStream* stream) override { std::unique_ptr<Assimp::IOStream>{stream}.reset(); }

 private:
  std::string_view bytes_;
  std::string name_;
};

/// Defects and omissions found while the meshes of a file are combined.
struct MeshDefects {
  std::int64_t not_finite = 0, odd_index = 0, no_area = 0, too_many = 0;
  std::int64_t first_not_finite = 0;
};

void append_corners(aiMesh const& mesh, double scale, Surface& surface, MeshDefects& defects) {
  for (auto const& v : std::span(mesh.mVertices, mesh.mVertices == nullptr ? 0 : mesh.mNumVertices)) {
    Vec<3> const X{{scale * v.x, scale * v.y, scale * v.z}};
    surface.X.push_back(X);
    if (std::isfinite(X[0]) && std::isfinite(X[1]) && std::isfinite(X[2])) continue;
    if (defects.not_finite++ == 0) defects.first_not_finite = static_cast<std::int64_t>(surface.X.size());
  }
}

/// Triangulating a polygon with more corners takes too long.
constexpr unsigned most_corners = 5000;

void append_faces(aiMesh const& mesh, int first, Surface& surface, MeshDefects& defects) {
  std::vector<int> loop;
  for (auto const& face : std::span(mesh.mFaces, mesh.mFaces == nullptr ? 0 : mesh.mNumFaces)) {
    std::span<unsigned const> const given(face.mIndices, face.mIndices == nullptr ? 0 : face.mNumIndices);
    loop.clear();
    for (unsigned const index : given)
      if (index < mesh.mNumVertices) loop.push_back(first + static_cast<int>(index));
    if (loop.size() < given.size()) {
      ++defects.odd_index;
    } else if (loop.size() < 3) {
      ++defects.no_area;
    } else if (loop.size() > most_corners) {
      ++defects.too_many;
    } else if (defects.not_finite == 0) {
      cut_polygon(surface.X, loop, surface.corner);
    }
  }
}

std::string group_of(aiScene const& scene, aiMesh const& mesh, bool several) {
  constexpr std::string_view given_by_reader = "defaultobject";
  std::string name = mesh.mName.C_Str();
  if (name == given_by_reader) name.clear();
  if (mesh.mMaterialIndex < scene.mNumMaterials && several) {
    aiString material;
    bool const given = scene.mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_NAME, material) == aiReturn_SUCCESS;
    std::string const of = given ? material.C_Str() : "";
    if (!of.empty() && of != AI_DEFAULT_MATERIAL_NAME && of != name) name += (name.empty() ? "" : "_") + of;
  }
  return name;
}

Surface surface_of_scene(aiScene const& scene, double scale, MeshDefects& defects) {
  Surface surface;
  for (auto const* mesh : std::span(scene.mMeshes, scene.mNumMeshes)) {
    int const first = static_cast<int>(surface.X.size()), group = static_cast<int>(surface.group_name.size());
    append_corners(*mesh, scale, surface, defects);
    append_faces(*mesh, first, surface, defects);
    if (surface.corner.size() == surface.group.size()) continue;
    surface.group.resize(surface.corner.size(), group);
    surface.group_name.push_back(group_of(scene, *mesh, scene.mNumMeshes > 1));
  }
  return surface;
}

void report_defects(MeshDefects const& defects, Surface const& surface, std::string const& name,
                    std::vector<std::string>& problems, std::vector<std::string>& notes) {
  if (defects.not_finite > 0)
    problems.push_back(fmt::format("{}: {} corners are no finite numbers, the first is corner {} - export it again",
                                   name, count_text(defects.not_finite), count_text(defects.first_not_finite)));
  if (defects.odd_index > 0)
    problems.push_back(fmt::format("{}: {} faces name corners that the file does not have - export it again", name,
                                   count_text(defects.odd_index)));
  if (defects.too_many > 0)
    problems.push_back(
        fmt::format("{}: {} faces have more than {} corners - let the CAD program cut them into "
                    "triangles",
                    name, count_text(defects.too_many), most_corners));
  if (defects.no_area > 0)
    notes.push_back(fmt::format("{}: {} lines and points are left out", name, count_text(defects.no_area)));
  if (problems.empty() && surface.corner.empty())
    problems.push_back(fmt::format("{}: there are no faces in it - export the surface, not lines or points", name));
}

/// Result of the child process.
struct ReadSurface {
  Surface surface;
  std::vector<std::string> problems, notes;
};

ReadSurface read_by_assimp(std::string_view bytes, std::string const& name, double scale) {
  ReadSurface read;
  Assimp::Importer importer;
  std::string const seen = "mesh." + mesh_format(name);
  importer.SetIOHandler(std::make_unique<OneFile>(bytes, seen).release());
  aiScene const* const scene = importer.ReadFile(seen, 0);
  if (scene == nullptr) {
    std::string why = importer.GetErrorString();
    std::replace(why.begin(), why.end(), '\n', ' ');
    read.problems.push_back(fmt::format("{}: is damaged or no {} file (the reader says {}) - export it again", name,
                                        mesh_format(name), in_quotes(why)));
    return read;
  }
  MeshDefects defects;
  read.surface = surface_of_scene(*scene, scale, defects);
  report_defects(defects, read.surface, name, read.problems, read.notes);
  return read;
}

std::string packed(ReadSurface const& read) {
  ByteWriter all;
  all.put(read.surface.X);
  all.put(read.surface.corner);
  all.put(read.surface.group);
  all.put(read.surface.group_name);
  all.put(read.problems);
  all.put(read.notes);
  return all.take();
}

bool take_apart(std::string_view bytes, ReadSurface& read) {
  ByteReader all(bytes);
  Surface& surface = read.surface;
  if (!all.take(surface.X) || !all.take(surface.corner) || !all.take(surface.group) || !all.take(surface.group_name) ||
      !all.take(read.problems) || !all.take(read.notes))
    return false;
  auto const corners = static_cast<int>(surface.X.size()), groups = static_cast<int>(surface.group_name.size());
  for (auto const& face : surface.corner)
    for (int const corner : face)
      if (corner < 0 || corner >= corners) return false;
  for (int const group : surface.group)
    if (group < 0 || group >= groups) return false;
  return surface.group.size() == surface.corner.size();
}

/// In a child process, unless there is no time limit: what crashes or hangs the reader is a problem of the file.
ReadSurface read_bounded(std::string_view bytes, std::string const& name, MeshOptions const& options) {
  if (!(options.time_limit > 0)) return read_by_assimp(bytes, name, options.scale);
  // Two hundred times what good files take; 60 bytes in memory for each one in the file.
  ChildLimits const limits{options.time_limit + 1e-6 * static_cast<double>(bytes.size()),
                           std::size_t{1'000'000'000} + 60 * bytes.size()};
  ChildAnswer answer = run_in_child_process([&] { return packed(read_by_assimp(bytes, name, options.scale)); }, limits);
  ReadSurface read;
  if (answer.trouble.empty() && !take_apart(answer.bytes, read)) answer.trouble = "answered nonsense";
  if (!answer.trouble.empty())
    read.problems.push_back(fmt::format("{}: is damaged or no {} file (the reader {}) - export it again", name,
                                        mesh_format(name), answer.trouble));
  return read;
}

}  // namespace

Surface surface_of_bytes(std::string_view bytes, std::string const& name, MeshOptions const& options,
                         std::vector<std::string>& problems, std::vector<std::string>& notes) {
  check_declared_sizes(bytes, name, problems);
  if (!problems.empty()) return {};
  ReadSurface read = read_bounded(bytes, name, options);
  problems = std::move(read.problems);
  notes.insert(notes.end(), read.notes.begin(), read.notes.end());
  return problems.empty() ? std::move(read.surface) : Surface{};
}

}  // namespace piola::geometry
