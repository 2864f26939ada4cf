// SPDX-License-Identifier: Apache-2.0
#include "dds/library_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <fastdds/dds/log/Log.hpp>

#include <mutex>
#include <vector>

#include "doubles/fake_clock.hpp"

namespace telehug {
namespace {

using testing::ElementsAre;
using testing::Optional;

class LibraryLogTest : public testing::Test {
 protected:
  std::optional<std::string> hear(const char* place, const char* message = "no") {
    return log.heard(place, message, clock.now());
  }

  FakeClock clock;
  LibraryLog log;
};

TEST_F(LibraryLogTest, TellsTheFirstMessageOfEachPlaceAtOnce) {
  EXPECT_THAT(hear("READER, ack", "no writer"), Optional(std::string("Fast DDS (READER, ack): no writer")));
  EXPECT_THAT(hear("READER, nack", "no writer"), Optional(std::string("Fast DDS (READER, nack): no writer")));
}

TEST_F(LibraryLogTest, TellsOfAStormOneMessageInTenMinutesAndHowManyThereWere) {
  hear("READER, ack", "0");
  for (int i = 1; i <= 1000; ++i)
    EXPECT_EQ(hear("READER, ack", std::to_string(i).c_str()), std::nullopt);
  clock.advance(LibraryLog::quiet_time);
  EXPECT_THAT(hear("READER, ack", "last"),
              Optional(std::string("Fast DDS (READER, ack): last (and 1000 like it since the last)")));
  EXPECT_EQ(hear("READER, ack"), std::nullopt);
}

TEST_F(LibraryLogTest, DoesNotGrowWithWhatItHears) {
  std::size_t told = 0;
  for (int i = 0; i < 1000; ++i)
    told += hear(("place " + std::to_string(i)).c_str()).has_value() ? 1U : 0U;
  EXPECT_EQ(told, LibraryLog::most_kinds);
}

TEST(LibraryLogOfFastDds, IsToldToUsAndToNobodyElse) {
  using eprosima::fastdds::dds::Log;
  std::mutex mutex;
  std::vector<std::string> told;
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  tell_library_log([&](const std::string& text) {
    const std::scoped_lock lock(mutex);
    told.push_back(text);
  });
  for (int i = 0; i < 3; ++i)
    Log::QueueLog("the storm", {"file", 1, "here", "PART"}, Log::Kind::Error);
  Log::Flush();
  tell_library_log([](const std::string&) {});
  EXPECT_EQ(testing::internal::GetCapturedStderr() + testing::internal::GetCapturedStdout(), "");
  const std::scoped_lock lock(mutex);
  EXPECT_THAT(told, ElementsAre("Fast DDS (PART, here): the storm"));
}

}  // namespace
}  // namespace telehug
