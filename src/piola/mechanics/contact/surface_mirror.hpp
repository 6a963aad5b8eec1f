// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace piola::contact {

/// A mirror plane of a body: coordinate `axis` is `at` [m] on it, and the body is on the side of the sign.
struct SurfaceMirror {
  int axis = 0;
  double at = 0, side = 1;
};

}  // namespace piola::contact
