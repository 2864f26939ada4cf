// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "integration/link_faults/faulty_link.hpp"

namespace telehug {

// The limits are 300 ms and 3 s; on a PC that may be busy twice that must do. The table shows what was measured.
inline constexpr double longest_off_ms = 600;
inline constexpr double longest_back_s = 6;

// Faults that one running link suffers one after the other.
class FaultyLinkTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { make_link(FaultyLink::Pairing::done); }
  static void TearDownTestSuite() {
    link.reset();
    if (!rows.empty()) fmt::print("\n{}\n", table_text(rows));
    rows.clear();
  }
  void SetUp() override {
    if (!link) GTEST_SKIP() << "network namespaces are not permitted here: " << why_not;
    const bool runs = link->pair.active && link->pair.active->runs() && link->pair.passive->runs();
    if (!(runs && link->settled())) {
      ASSERT_TRUE(link->start_all()) << link->pair.logs();
    }
  }

  static void make_link(FaultyLink::Pairing pairing) {
    try {
      link = std::make_unique<FaultyLink>(pairing);
    } catch (const std::system_error& error) {
      why_not = error.what();
    }
  }

  static void expect_silence_and_return(const FaultRow& row, double off_ms = longest_off_ms) {
    ASSERT_TRUE(row.off_after_ms) << row.fault << ": a motor went on" << link->pair.logs();
    EXPECT_LE(*row.off_after_ms, off_ms) << row.fault << link->pair.logs();
    expect_return(row);
  }
  static void expect_return(const FaultRow& row) {
    rows.push_back(row);
    ASSERT_TRUE(row.back_after_s) << row.fault << ": not felt again" << link->pair.logs();
    EXPECT_LE(*row.back_after_s, longest_back_s) << row.fault << link->pair.logs();
  }

  inline static std::unique_ptr<FaultyLink> link;
  inline static std::string why_not;
  inline static std::vector<FaultRow> rows;
};

}  // namespace telehug
