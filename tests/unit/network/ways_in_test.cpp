// SPDX-License-Identifier: Apache-2.0
#include "network/ways_in.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace telehug {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(WaysIn, AreNoneByPrivateAddresses) {
  for (const char* inner :
       {"10.1.2.3", "172.16.0.1", "172.31.255.255", "192.168.1.20", "169.254.7.7", "127.0.0.1", "0.0.0.0", "224.0.0.1",
        "255.255.255.255", "198.18.0.1", "fe80::1", "fd00::1", "fc00::1", "::1", "ff02::1", "nonsense", ""}) {
    const WaysIn ways = ways_in({inner});
    EXPECT_EQ(ways.ipv4 + ways.ipv6, "") << inner;
    EXPECT_FALSE(ways.carrier_nat) << inner;
  }
}

TEST(WaysIn, AreByTheInternetsAddresses) {
  for (const char* outer : {"198.51.100.7", "172.15.0.1", "172.32.0.1", "192.167.1.1", "100.63.255.255", "100.128.0.0",
                            "11.0.0.1", "223.255.255.255"})
    EXPECT_EQ(ways_in({"192.168.1.20", outer}).ipv4, outer);
  for (const char* outer : {"2001:db8::7", "2a02::1", "3fff::1"})
    EXPECT_EQ(ways_in({"fe80::1", "fd00::1", outer}).ipv6, outer);
}

TEST(WaysIn, KnowACarriersNat) {
  EXPECT_TRUE(ways_in({"100.64.0.1"}).carrier_nat);
  EXPECT_TRUE(ways_in({"192.168.1.20", "100.127.255.255"}).carrier_nat);
  EXPECT_FALSE(ways_in({"100.63.255.255", "100.128.0.0"}).carrier_nat);
}

TEST(WaysIn, AreToldWithWhatIsToBeDone) {
  EXPECT_THAT(advice(ways_in({"198.51.100.7"}), "51820"), HasSubstr("198.51.100.7: it can be dialled there"));
  EXPECT_THAT(advice(ways_in({"192.168.1.20"}), "51820"), HasSubstr("router forwards UDP port 51820"));
  EXPECT_THAT(advice(ways_in({"192.168.1.20", "2001:db8::7"}), "4711"),
              testing::AllOf(HasSubstr("2001:db8::7"), HasSubstr("forwards UDP port 4711")));
  const std::string behind_nat = advice(ways_in({"100.64.0.1"}), "51820");
  EXPECT_THAT(behind_nat, HasSubstr("nobody can dial this PC"));
  EXPECT_THAT(behind_nat, Not(HasSubstr("forwards")));
  EXPECT_THAT(advice(ways_in({"100.64.0.1", "2001:db8::7"}), "51820"),
              HasSubstr("2001:db8::7: it can be dialled there"));
}

TEST(LastingAddresses, LeaveOutThoseThatAreGivenUpAfterAWhile) {
  EXPECT_THAT(lasting_ipv6_addresses("20010db8000000000000000000000007 02 40 00 80     eth0\n"
                                     "20010db8000000000000000000000008 02 40 00 01     eth0\n"
                                     "20010db8000000000000000000000009 02 40 00 20     eth0\n"
                                     "fe800000000000000000000000000001 02 40 20 80     eth0\n"
                                     "2001 02 40 00 80 eth0\n\n"),
              ElementsAre("2001:db8::7", "fe80::1"));
  EXPECT_TRUE(lasting_ipv6_addresses("").empty());
}

}  // namespace
}  // namespace telehug
