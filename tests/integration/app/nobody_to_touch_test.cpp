// SPDX-License-Identifier: Apache-2.0
//
// The camera is open only while somebody can be touched, and without a face nothing is sent.
#include <gtest/gtest.h>

#include <fstream>

#include "doubles/test_pictures.hpp"
#include "integration/app/running_pair.hpp"

namespace telehug {
namespace {

class NobodyToTouch : public testing::Test {
 protected:
  NobodyToTouch() { pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2"); }

  [[nodiscard]] bool camera_says(const std::string& why) const {
    const auto status = pair.status(Side::active);
    return status.is_object() && status.at("camera").at("why") == why;
  }

  RunningPair pair;
};

TEST_F(NobodyToTouch, TheCameraIsOpenOnlyWhileAPeerIsConnected) {
  pair.start_active();
  ASSERT_TRUE(eventually([&] { return pair.complains(Side::active, "no peer is connected"); })) << pair.logs();
  EXPECT_TRUE(eventually([&] { return camera_says("nobody needs it"); })) << pair.logs();
  EXPECT_FALSE(pair.camera_open());

  pair.start_jacket();
  pair.start_passive();
  ASSERT_TRUE(eventually([&] { return pair.camera_open(); })) << pair.logs();
  EXPECT_TRUE(camera_says("a peer is connected"));
  EXPECT_TRUE(pair.status(Side::active).at("screen").at("open"));

  pair.passive->kill_now();
  EXPECT_TRUE(eventually([&] { return !pair.camera_open(); })) << pair.logs();
  EXPECT_TRUE(eventually([&] { return pair.status(Side::active).at("screen").at("open") == false; })) << pair.logs();
  EXPECT_TRUE(pair.complains(Side::active, "no peer is connected"));
  EXPECT_EQ(pair.counter(Side::active, "peer_losses"), 1U);
}

TEST_F(NobodyToTouch, WithoutAFaceTouchesAreCountedAndNothingIsSentUntilThereIsOne) {
  const std::vector<std::uint8_t> grey = jpeg_of(plain_picture(640, 400, {90, 90, 90}));
  pair.picture = pair.folder.write("chat.jpg", {reinterpret_cast<const char*>(grey.data()), grey.size()});
  pair.start_jacket();
  pair.start_passive();
  pair.start_active();
  ASSERT_TRUE(eventually([&] { return pair.counter(Side::active, "touches_without_face") > 0; })) << pair.logs();
  EXPECT_TRUE(pair.complains(Side::active, "No face")) << pair.logs();
  EXPECT_EQ(pair.status(Side::active).at("state"), "fault");
  EXPECT_EQ(pair.counter(Side::active, "events_published"), 0U);
  EXPECT_EQ(pair.counter(Side::passive, "events_received"), 0U);

  std::filesystem::copy(TELEHUG_FIXTURES "/chat/01_full.jpg", pair.folder / "new.jpg");
  std::filesystem::rename(pair.folder / "new.jpg", pair.picture);
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
  EXPECT_FALSE(pair.complains(Side::active, "No face"));
}

TEST_F(NobodyToTouch, AChatPictureThatIsMissingIsToldAndTakenWhenItIsThere) {
  pair.picture = pair.folder / "chat.jpg";
  pair.start_jacket();
  pair.start_passive();
  pair.start_active();
  ASSERT_TRUE(eventually([&] { return pair.counter(Side::active, "touches_without_face") > 0; })) << pair.logs();
  EXPECT_EQ(pair.status(Side::active).at("state"), "fault") << pair.logs();
  EXPECT_TRUE(pair.complains(Side::active, pair.picture.string())) << pair.logs();
  EXPECT_EQ(pair.counter(Side::active, "events_published"), 0U);

  std::filesystem::copy(TELEHUG_FIXTURES "/chat/01_full.jpg", pair.picture);
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
}

}  // namespace
}  // namespace telehug
