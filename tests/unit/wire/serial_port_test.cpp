// SPDX-License-Identifier: Apache-2.0
#include "wire/serial_port.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/serial.h>
#include <sys/ioctl.h>
#include <termios.h>

#include "doubles/fake_clock.hpp"
#include "doubles/ioctl_double.hpp"
#include "doubles/pseudo_terminal.hpp"
#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// Serial devices that come and go under names of their own.
class SerialOpenerTest : public ::testing::Test {
 protected:
  SerialOpenerTest() { std::filesystem::create_directory(by_id); }

  std::string plug(const PseudoTerminal& terminal, const std::string& name) {
    std::filesystem::create_symlink(terminal.path(), by_id / name);
    return by_id / name;
  }
  Result<Wire> open(SerialOpener& opener) { return *opener.open(clock.now()); }
  std::string error(SerialOpener& opener) {
    const auto wire = open(opener);
    return wire ? "it opens" : wire.error().message;
  }

  const TemporaryFolder folder;
  const std::filesystem::path by_id = folder / "by-id";
  const FakeClock clock;
};

TEST_F(SerialOpenerTest, OpensTheDeviceThatAPathNames) {
  const PseudoTerminal terminal;
  SerialOpener opener(plug(terminal, "usb-A"), default_baud, by_id);
  auto wire = open(opener);
  ASSERT_TRUE(wire) << wire.error().message;
  EXPECT_EQ(wire->write(std::vector<std::uint8_t>{0, 13, 10, 3}), 4U);
  EXPECT_THAT(terminal.read(4), ElementsAre(0, 13, 10, 3)) << "no byte means anything to the terminal";
}

TEST_F(SerialOpenerTest, FollowsAnIdToAnotherTerminal) {
  PseudoTerminal first;
  const std::string path = plug(first, "usb-A");
  SerialOpener opener(path, default_baud, by_id);
  ASSERT_TRUE(open(opener));
  first.unplug();
  std::filesystem::remove(path);
  EXPECT_THAT(error(opener), HasSubstr("plug the jacket in"));
  const PseudoTerminal second;
  plug(second, "usb-A");
  auto wire = open(opener);
  ASSERT_TRUE(wire);
  (void)wire->write(std::vector<std::uint8_t>{5});
  EXPECT_THAT(second.read(1), ElementsAre(5));
}

TEST_F(SerialOpenerTest, FindsTheOnlySerialDeviceThereIs) {
  SerialOpener opener("auto", default_baud, by_id);
  EXPECT_EQ(opener.device(), "serial:auto");
  EXPECT_THAT(error(opener), HasSubstr("plug the jacket in"));
  const PseudoTerminal terminal;
  const std::string path = plug(terminal, "usb-A");
  EXPECT_TRUE(open(opener));
  EXPECT_EQ(opener.device(), path);
}

TEST_F(SerialOpenerTest, FindsItAgainUnderAnotherName) {
  PseudoTerminal first;
  const std::string path = plug(first, "usb-A");
  SerialOpener opener("auto", default_baud, by_id);
  ASSERT_TRUE(open(opener));
  first.unplug();
  std::filesystem::remove(path);
  const PseudoTerminal second;
  plug(second, "usb-B");
  auto wire = open(opener);
  ASSERT_TRUE(wire);
  (void)wire->write(std::vector<std::uint8_t>{5});
  EXPECT_THAT(second.read(1), ElementsAre(5));
}

TEST_F(SerialOpenerTest, SaysWhichDevicesThereAreInsteadOfTakingTheWrongOne) {
  const PseudoTerminal first;
  const PseudoTerminal second;
  const std::string a = plug(first, "usb-A");
  const std::string b = plug(second, "usb-B");
  SerialOpener opener("auto", default_baud, by_id);
  EXPECT_EQ(error(opener), "there are 2 serial devices; name the jacket's, one of serial:" + a + ", serial:" + b);
}

TEST_F(SerialOpenerTest, HasNoDevicesWhereUdevHasMadeNoFolder) {
  EXPECT_THAT(serial_devices(folder / "nothing"), IsEmpty());
}

TEST_F(SerialOpenerTest, OffersTheNameThatStaysInPlaceOfOneThatChanges) {
  SerialOpener changing("/dev/ttyUSB99", default_baud, by_id);
  EXPECT_THAT(error(changing), Not(HasSubstr("stays"))) << "there is none";
  const PseudoTerminal terminal;
  const std::string path = plug(terminal, "usb-A");
  EXPECT_THAT(error(changing), HasSubstr("serial:" + path + " stays one and the same"));
  SerialOpener other("/nonexistent/jacket", default_baud, by_id);
  EXPECT_THAT(error(other), Not(HasSubstr("stays")));
}

TEST_F(SerialOpenerTest, LetsNoSecondProgramUseThePort) {
  const PseudoTerminal terminal;
  SerialOpener first(terminal.path(), default_baud, by_id);
  SerialOpener second(terminal.path(), default_baud, by_id);
  {
    const auto wire = open(first);
    ASSERT_TRUE(wire);
    EXPECT_THAT(error(second), HasSubstr("Device or resource busy; close the program that uses it"));
  }
  EXPECT_TRUE(open(second)) << "the first has let go of it";
}

TEST_F(SerialOpenerTest, AsksTheDriverToHoldNoAnswersBack) {
  const PseudoTerminal terminal;
  int flags = ASYNC_SPD_HI;
  const IoctlDouble kernel([&](int, unsigned long request, void* argument) -> std::optional<int> {
    if (request == TIOCGSERIAL) static_cast<serial_struct*>(argument)->flags = flags;
    if (request == TIOCSSERIAL) flags = static_cast<serial_struct*>(argument)->flags;
    return request == TIOCGSERIAL || request == TIOCSSERIAL ? std::optional(0) : std::nullopt;
  });
  SerialOpener opener(terminal.path(), default_baud, by_id);
  EXPECT_TRUE(open(opener));
  EXPECT_EQ(static_cast<unsigned>(flags), ASYNC_SPD_HI | ASYNC_LOW_LATENCY) << "and nothing else has changed";
}

TEST_F(SerialOpenerTest, BearsADriverThatCanHoldAnswersBackOnly) {
  const PseudoTerminal terminal;
  const IoctlDouble kernel([](int, unsigned long request, void*) -> std::optional<int> {
    return request == TIOCSSERIAL ? std::optional(-1) : request == TIOCGSERIAL ? std::optional(0) : std::nullopt;
  });
  SerialOpener opener(terminal.path(), default_baud, by_id);
  EXPECT_TRUE(open(opener));
}

TEST_F(SerialOpenerTest, DoesNotResetTheJacketByClosingThePort) {
  const PseudoTerminal terminal;
  SerialOpener opener(terminal.path(), default_baud, by_id);
  const auto wire = open(opener);
  ASSERT_TRUE(wire);
  const int fd = ::open(terminal.path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  termios settings{};
  ASSERT_EQ(tcgetattr(fd, &settings), 0);
  close(fd);
  EXPECT_EQ(settings.c_cflag & HUPCL, 0U);
  EXPECT_EQ(cfgetospeed(&settings), speed_t{B57600});
}

}  // namespace
}  // namespace telehug
