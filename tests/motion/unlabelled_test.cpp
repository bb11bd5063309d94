// Tests which names mark unlabelled points.
#include "motion/names.hpp"

#include <gtest/gtest.h>

namespace kinemend {
namespace {

TEST(Unlabelled, ANumberOfTheSystemIsNoLabel) {
  for (const char* name : {"", " ", "*", "*52", "Ann:*3", "U_12", "u_7", "uname*5",
                           "Unlabeled 1234", "Unlabelled_2", "Rigid:Unlabeled"}) {
    EXPECT_TRUE(is_unlabelled(name)) << name;
  }
  for (const char* name : {"LASI", "Ann:LASI", "U_", "U_A", "U1", "C7", "T10", "Marker 12", "*A"})
    EXPECT_FALSE(is_unlabelled(name)) << name;
}

}  // namespace
}  // namespace kinemend
