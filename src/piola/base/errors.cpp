// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <filesystem>
#include <new>
#include <numeric>

namespace piola {
namespace {

std::string place_text(Place const& place) {
  std::string text = place.file;
  if (place.line > 0) text += ":" + std::to_string(place.line);
  if (place.line > 0 && place.column > 0) text += ":" + std::to_string(place.column);
  return text;
}

}  // namespace

void Problems::add(Place const& place, std::string text) {
  PIOLA_EXPECTS(!text.empty());
  PIOLA_EXPECTS(place.line >= 0 && place.column >= 0);
  std::string const where = place_text(place);
  lines_.push_back(where.empty() ? std::move(text) : where + ": " + text);
  places_.push_back(place);
}

void Problems::sort_by_place() {
  PIOLA_EXPECTS(places_.size() == lines_.size());
  std::vector<std::size_t> order(lines_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(places_[a].line, places_[a].column) < std::pair(places_[b].line, places_[b].column);
  });
  std::vector<std::string> lines;
  std::vector<Place> places;
  for (std::size_t const i : order) {
    lines.push_back(std::move(lines_[i]));
    places.push_back(std::move(places_[i]));
  }
  lines_ = std::move(lines);
  places_ = std::move(places);
}

void Problems::raise_if_any() const {
  if (lines_.empty()) return;
  std::string message;
  for (std::string const& line : lines_) message += (message.empty() ? "" : "\n") + line;
  throw InputError(message);
}

ErrorReport report_of(std::exception_ptr const& error) {
  PIOLA_EXPECTS(error != nullptr);
  try {
    std::rethrow_exception(error);
  } catch (InputError const& e) {
    return {bad_input, e.what()};
  } catch (PhysicsError const& e) {
    return {physics_failed, e.what()};
  } catch (FileError const& e) {
    return {internal_error, e.what()};
  } catch (std::filesystem::filesystem_error const& e) {
    return {internal_error, e.path1().string() + ": cannot be used, " + e.code().message() + " - check the path"};
  } catch (std::bad_alloc const&) {
    return {internal_error,
            "not enough memory for this many particles - choose fewer ('piola check' reports how much is needed)"};
  } catch (std::exception const& e) {
    return {internal_error, std::string("internal error, please report it: ") + e.what()};
  } catch (...) {
    return {internal_error, "internal error of an unknown kind, please report it"};
  }
}

}  // namespace piola
