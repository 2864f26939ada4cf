// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "doubles/example_messages.hpp"
#include "peer/session_id.hpp"
#include "peer/session_succession.hpp"

namespace telehug {
namespace {

using Standing = SessionSuccession::Standing;

TEST(ANewSessionId, IsWellFormedAndNeverTheSame) {
  const SessionId one = new_session_id();
  EXPECT_TRUE(is_session_id(one)) << one;
  EXPECT_NE(one, new_session_id());
}

TEST(ASessionId, Is32LowerCaseHexadecimalDigitsNotAllZero) {
  EXPECT_TRUE(is_session_id(example_session));
  EXPECT_FALSE(is_session_id(""));
  EXPECT_FALSE(is_session_id(example_session.substr(1)));
  EXPECT_FALSE(is_session_id(example_session + "0"));
  EXPECT_FALSE(is_session_id(std::string(32, '0')));
  EXPECT_FALSE(is_session_id(std::string(32, 'F')));
  EXPECT_FALSE(is_session_id(std::string(32, 'g')));
}

TEST(SessionSuccession, ANewSessionReplacesTheOldOneForGood) {
  SessionSuccession sessions;
  EXPECT_EQ(sessions.admit(example_session), Standing::successor);
  EXPECT_EQ(sessions.admit(example_session), Standing::current);
  EXPECT_EQ(sessions.admit(other_session), Standing::successor);
  EXPECT_EQ(sessions.admit(example_session), Standing::retired);
  EXPECT_EQ(sessions.admit(other_session), Standing::current);
  EXPECT_EQ(sessions.current(), other_session);
}

}  // namespace
}  // namespace telehug
