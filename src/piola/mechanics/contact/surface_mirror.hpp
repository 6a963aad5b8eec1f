// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace piola::contact {

/// A mirror plane of a body: coordinate `axis` equals `at` [m] on it; the body is on the side given by the sign.
struct SurfaceMirror {
  int axis = 0;
  double at = 0, side = 1;
};

}  // namespace piola::contact
