// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace piola {

/// One line of a plot; values that are not finite break it.
struct Curve {
  std::string label;
  std::vector<double> x, y;
  int colour = 0;      ///< number in the palette of Okabe and Ito
  int dash = 0;        ///< 0 whole, then broken in different ways
  bool marks = false;  ///< rings around the points, and no line between them
};

struct PlotAxis {
  std::string name, unit;  ///< SI; values are shown with a prefix that fits
  bool logarithmic = false;
};

/// Curves over one axis, with their names at their ends.
struct Plot {
  std::string title, note;  ///< the note is at the right, above the frame
  std::string remark = {};  ///< in the middle of the frame
  PlotAxis x, y;
  std::vector<Curve> curves;
  int width = 800, height = 500;  ///< pixels; points in PDF
};

/// Draws to NAME.svg, NAME.png or NAME.pdf, the same picture in each. Throws InputError for another name, or if there
/// is nothing to draw (no finite value, none above zero on a logarithmic axis); FileError if it cannot be written.
void write_plot(std::filesystem::path const& path, Plot const& plot);

/// A plot as the text of an SVG, with the position of its frame, for a cursor that moves over it.
struct PlotText {
  std::string svg = {};
  double left = 0, right = 0, top = 0, bottom = 0;  ///< of the frame, in pixels from the top left
  double low = 0, high = 0;                         ///< values at `left` and `right`
};
PlotText plot_text(Plot const& plot);

}  // namespace piola
