// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/delaunay_hull.hpp"
#include "piola/base/contracts.hpp"
#include "piola/neighbours/simplex.hpp"
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace piola {
namespace {

/// Captures the messages of Qhull as text.
class Messages {
 public:
  Messages() : file_(open_memstream(&text_, &size_)) {}
  Messages(Messages const&) = delete;
  Messages& operator=(Messages const&) = delete;
  ~Messages() {
    if (file_ != nullptr) std::fclose(file_);
    std::free(text_);
  }
  std::FILE* file() const { return file_; }
  std::string first_line() const {
    if (file_ == nullptr || std::fflush(file_) != 0) return {};
    std::string const all(text_, size_);
    return all.substr(0, all.find('\n'));
  }

 private:
  char* text_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* file_;
};

/// One run of Qhull and its memory.
class Hull {
 public:
  Hull(std::vector<double>& coordinates, int dimension) : qh_(std::make_unique<qhT>()) {
    if (messages_.file() == nullptr) return;
    qh_zero(qh_.get(), messages_.file());
    auto const count = static_cast<int>(coordinates.size() / static_cast<std::size_t>(dimension));
    std::string command = "qhull Pp";
    code_ =
        qh_new_qhull(qh_.get(), dimension, count, coordinates.data(), False, command.data(), nullptr, messages_.file());
  }
  Hull(Hull const&) = delete;
  Hull& operator=(Hull const&) = delete;
  ~Hull() {
    if (messages_.file() == nullptr) return;
    int current = 0, total = 0;
    qh_freeqhull(qh_.get(), !qh_ALL);
    qh_memfreeshort(qh_.get(), &current, &total);
  }
  bool good() const { return code_ == 0; }
  std::string trouble() const { return messages_.file() == nullptr ? "out of memory" : messages_.first_line(); }
  facetT const* first_facet() const { return qh_->facet_list; }
  Index number_of(vertexT const* vertex) const { return static_cast<Index>(qh_pointid(qh_.get(), vertex->point)); }

 private:
  Messages messages_;
  std::unique_ptr<qhT> qh_;
  int code_ = -1;
};

/// The elements of one of Qhull's sets, which end with a null pointer.
template <class T, class Visit>
void for_each(setT const* set, Visit const& visit) {
  if (set == nullptr) return;
  for (setelemT const* e = set->e; e->p != nullptr; ++e) visit(static_cast<T const*>(e->p));
}

std::vector<Index> numbers(Hull const& hull, setT const* vertices) {
  std::vector<Index> out;
  for_each<vertexT>(vertices, [&](vertexT const* v) { out.push_back(hull.number_of(v)); });
  return out;
}

/// A facet with more corners, cut into the simplices between one of its corners and the ridges that do not contain it.
/// Ridges stay, so that the facets beside it fit. The corner is the one that makes the smallest simplex largest.
std::vector<Index> star(std::vector<Index> const& corners, std::vector<std::vector<Index>> const& ridges,
                        Points const& points, int dimension) {
  std::vector<Index> best;
  double best_smallest = -1;
  for (Index const apex : corners) {
    std::vector<Index> simplices;
    double smallest = std::numeric_limits<double>::infinity();
    for (auto const& ridge : ridges) {
      if (std::find(ridge.begin(), ridge.end(), apex) != ridge.end()) continue;
      simplices.push_back(apex);
      simplices.insert(simplices.end(), ridge.begin(), ridge.end());
      Index const* const corner = simplices.data() + (simplices.size() - static_cast<std::size_t>(dimension) - 1);
      smallest = std::min(smallest, std::fabs(simplex_volume(points, corner, dimension)));
    }
    if (smallest > best_smallest) {
      best_smallest = smallest;
      best = simplices;
    }
  }
  return best;
}

void add_simplices(Hull const& hull, facetT const& facet, Points const& points, int dimension,
                   std::vector<Index>& corner) {
  std::vector<Index> simplices = numbers(hull, facet.vertices);
  if (simplices.size() != static_cast<std::size_t>(dimension) + 1) {
    std::vector<std::vector<Index>> ridges;
    for_each<ridgeT>(facet.ridges, [&](ridgeT const* r) { ridges.push_back(numbers(hull, r->vertices)); });
    simplices = star(simplices, ridges, points, dimension);
  }
  corner.insert(corner.end(), simplices.begin(), simplices.end());
}

}  // namespace

LowerHull lower_hull(Points const& points, std::vector<double> const& height, int dimension) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  PIOLA_EXPECTS(height.size() == points.size());
  std::vector<double> coordinates;
  coordinates.reserve(points.size() * static_cast<std::size_t>(dimension + 1));
  for (std::size_t p = 0; p < points.size(); ++p) {
    coordinates.insert(coordinates.end(), points[p].begin(), points[p].begin() + dimension);
    coordinates.push_back(height[p]);
  }
  Hull const hull(coordinates, dimension + 1);
  LowerHull lower;
  if (!hull.good()) {
    lower.trouble = hull.trouble();
    return lower;
  }
  for (facetT const* f = hull.first_facet(); f != nullptr && f->next != nullptr; f = f->next)
    if (f->normal != nullptr && f->normal[dimension] < 0) add_simplices(hull, *f, points, dimension, lower.corner);
  PIOLA_ENSURES(lower.corner.size() % static_cast<std::size_t>(dimension + 1) == 0);
  return lower;
}

}  // namespace piola
