// SPDX-License-Identifier: Apache-2.0
//
// A touch that the camera sees moves the motors of its box, and no others.
#include <gmock/gmock.h>

#include <algorithm>

#include "demo_verdict.hpp"
#include "integration/app/running_pair.hpp"
#include "jacket/load_jacket_profile.hpp"

namespace telehug {
namespace {

using testing::IsEmpty;

class TouchToPin : public testing::Test {
 protected:
  // What both sides tell, from the start of the active side until this many contacts were sent and the last is over.
  void record_touches(std::ptrdiff_t contacts) {
    ASSERT_TRUE(eventually([&] { return pair.jacket_state() == "armed"; })) << pair.logs();
    ControlClient passive = watch(Side::passive);
    pair.start_active();
    ASSERT_TRUE(eventually([&] { return pair.status(Side::active).is_object(); })) << pair.logs();
    ControlClient active = watch(Side::active);
    const auto hear = [&] {
      for (ControlClient* side : {&active, &passive}) {
        auto event = side->next(1ms);
        while (event && *event) {
          record.add(**event);
          event = side->next(0ms);
        }
      }
    };
    ASSERT_TRUE(eventually([&] { return hear(), count("down") >= contacts; })) << pair.logs();
    ASSERT_EQ(pair.telehug("stop", Side::active).code, 0);
    ASSERT_TRUE(eventually([&] { return hear(), count("up") == count("down") && ended() == count("up"); }))
        << pair.logs();
    ASSERT_TRUE(eventually([&] { return !pair.felt(); })) << pair.logs();
    record.pins = pair.pins();
  }

  ControlClient watch(Side side) {
    auto client = std::get<ControlClient>(ControlClient::connect(pair.socket(side)));
    EXPECT_TRUE(client.ask({{"command", "watch"}}));
    return client;
  }
  [[nodiscard]] std::ptrdiff_t count(const char* phase) const {
    return std::ranges::count(record.published, phase, &PublishedTouch::phase);
  }
  [[nodiscard]] std::ptrdiff_t ended() const { return std::ranges::count(record.felt, "up", &FeltAnswer::phase); }

  RunningPair pair;
  DemoRecord record;
  JacketProfile profile = load_jacket_profile(pair.folder / "tireless.toml").value();
};

// A finger that slides over four boxes, slowly enough that each is felt even if a busy PC drops frames.
TEST_F(TouchToPin, ARecordedTouchMovesTheMotorsOfItsBoxesAndNoOthers) {
  constexpr int slower = 6;
  const auto folder = pair.folder / "slow";
  std::filesystem::create_directory(folder);
  for (const auto& picture : std::filesystem::directory_iterator(TELEHUG_FIXTURES "/rig2/sequence")) {
    if (picture.path().extension() != ".jpg") continue;
    for (int i = 0; i < slower; ++i)
      std::filesystem::create_symlink(picture,
                                      folder / (picture.path().stem().string() + "-" + std::to_string(i) + ".jpg"));
  }
  pair.camera = "replay:" + folder.string();
  pair.start_jacket();
  pair.start_passive();
  pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
  ASSERT_NO_FATAL_FAILURE(record_touches(2));
  EXPECT_THAT(faults(record, profile), IsEmpty()) << pair.logs();
}

TEST_F(TouchToPin, ATouchOfTheVirtualRigMovesTheMotorsOfItsBoxesAndNoOthers) {
  pair.camera = "virtual";
  pair.start_jacket();
  pair.start_passive();
  pair.calibrate(pair.camera);
  ASSERT_NO_FATAL_FAILURE(record_touches(2));
  EXPECT_THAT(faults(record, profile), IsEmpty()) << pair.logs();
}

TEST_F(TouchToPin, AFingerThatRestsIsFeltWithoutAGap) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  // On a PC so busy that the sides lose each other, the motors must stop; there is a quiet while in the end.
  EXPECT_TRUE(eventually([&] {
    const auto changes = pair.pins().size();
    const auto frames = pair.counter(Side::active, "frames");
    return eventually([&] { return pair.counter(Side::active, "frames") > frames + 40; }) && pair.felt() &&
           pair.pins().size() == changes;
  })) << pair.logs();
}

}  // namespace
}  // namespace telehug
