// SPDX-License-Identifier: Apache-2.0
#include "piola/domain/halo.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

TEST(Halo, RefreshBringsEveryNamedFieldUpToDate) {
  Field a("A", "1", 1, Role::evolved), b("B", "1", 1, Role::evolved), c("C", "1", 1, Role::evolved);
  for (Field* f : {&a, &b, &c}) {
    f->allocate(1, 0);
    f->ref().version->owner = 3;
  }
  Halo().refresh(a.ref(), b.ref());
  EXPECT_EQ(a.ref().version->halo, 3U);
  EXPECT_EQ(b.ref().version->halo, 3U);
  EXPECT_EQ(c.ref().version->halo, 0U);
}

TEST(Halo, RefreshOfAFieldWithoutVersionDoesNothing) {
  FieldRef const bare;
  EXPECT_NO_THROW(Halo().refresh(bare));
}

}  // namespace
}  // namespace piola
