// SPDX-License-Identifier: Apache-2.0
#include "finger/mirror_evidence.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace telehug {
namespace {

TEST(MirrorEvidence, CountsAsMuchAsTheNetIsSureBeyondWhatItLearnedOn) {
  EXPECT_EQ(mirror_evidence(2.5, 3).state, MirrorState::touching);
  EXPECT_DOUBLE_EQ(mirror_evidence(2.5, 3).log_ratio, 1.5);
  EXPECT_EQ(mirror_evidence(2.5, 3).hover_mm, 0);
  EXPECT_EQ(mirror_evidence(-2, 12).state, MirrorState::hovering);
  EXPECT_DOUBLE_EQ(mirror_evidence(-2, 12).log_ratio, 3);
  EXPECT_EQ(mirror_evidence(-2, 12).hover_mm, 12);
}

TEST(MirrorEvidence, NeverCountsForMoreThanWasMeasured) {
  EXPECT_DOUBLE_EQ(mirror_evidence(30, 0).log_ratio, 4);
  EXPECT_DOUBLE_EQ(mirror_evidence(-30, 50).log_ratio, 4);
}

TEST(MirrorEvidence, IsNoneWhereTheNetIsNotSure) {
  for (const double logit : {-1.3, 0.0, 0.9, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(mirror_evidence(logit, 5).state, MirrorState::unknown) << logit;
    EXPECT_EQ(mirror_evidence(logit, 5).log_ratio, 0) << logit;
  }
}

}  // namespace
}  // namespace telehug
