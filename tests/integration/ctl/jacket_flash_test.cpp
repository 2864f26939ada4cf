// SPDX-License-Identifier: Apache-2.0
//
// `telehug jacket flash` and the real avrdude, against real bootloaders in a simulated chip, and against a programmer.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>
#include <thread>

#include "doubles/temporary_folder.hpp"
#include "integration/ctl/intel_hex.hpp"
#include "integration/ctl/isp_programmer.hpp"
#include "integration/ctl/simulated_board.hpp"
#include "link/make_link.hpp"
#include "service/exit_code.hpp"
#include "wire/serial_port.hpp"

namespace telehug {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// Of the Debian package arduino-core-avr.
const std::filesystem::path bootloaders = "/usr/share/arduino/hardware/arduino/avr/bootloaders";
const std::filesystem::path firmware = TELEHUG_FIRMWARE_FOLDER "/telehug-jacket.hex";

struct Outcome {
  int code = -1;
  std::string text;  // both streams
};

class JacketFlash : public testing::Test {
 protected:
  // With a configuration of its own in place of the user's.
  Outcome flash(const std::string& arguments, const std::string& before = "") const {
    const auto output = folder / "output.txt";
    const std::string line = before + " /usr/bin/env XDG_CONFIG_HOME=" + folder.path().string() +
                             " " TELEHUG_BIN "/telehug jacket flash " + arguments + " >" + output.string() + " 2>&1";
    const int status = std::system(line.c_str());
    std::ostringstream text;
    text << std::ifstream(output).rdbuf();
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text.str()};
  }

  [[nodiscard]] SimulatedBoard board_with_optiboot(std::optional<std::uint32_t> worn_cell = {}) const {
    return SimulatedBoard({.bootloader = compiled_optiboot("atmega328p", "0x7E00"), .worn_cell = worn_cell});
  }

  // The package's own file for the ATmega328P is longer than its 512 bytes, which reach to the end of the flash.
  // Without the LED's flashes avr-gcc makes it fit.
  [[nodiscard]] std::filesystem::path compiled_optiboot(const std::string& chip, const std::string& start) const {
    const std::string elf = folder / "optiboot.elf";
    const std::string hex = folder / "optiboot.hex";
    const std::string source = bootloaders / "optiboot/optiboot.c";
    const std::string compile =
        "avr-gcc -w -Os -fno-inline-small-functions -fno-split-wide-types -mrelax -mmcu=" + chip +
        " -DF_CPU=16000000L -DLED_START_FLASHES=0 -DBAUD_RATE=115200 -nostartfiles -nostdlib"
        " -Wl,--relax -Wl,--section-start=.text=" +
        start + " " + source + " -o " + elf;
    // Its version, which nothing here reads, stays out.
    const std::string convert = "avr-objcopy -j .text -j .data -O ihex " + elf + " " + hex;
    if (std::system((compile + " && " + convert).c_str()) != 0)
      throw std::runtime_error("optiboot can't be compiled: run deploy/setup test");
    return hex;
  }

  TemporaryFolder folder;
};

std::vector<std::uint8_t> as_written(const std::filesystem::path& hex_file, const std::vector<std::uint8_t>& flash) {
  std::vector<std::uint8_t> expected = flash;
  for (const auto& [address, byte] : read_intel_hex(hex_file))
    expected.at(address) = byte;
  return expected;
}

TEST_F(JacketFlash, WritesTheFirmwareThroughOptibootAndTheJacketAnswers) {
  SimulatedBoard board = board_with_optiboot();
  const Outcome outcome = flash("--yes --port " + board.port());
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("optiboot 4.4 answers at 115200 baud"),
                                  HasSubstr(std::to_string(read_intel_hex(firmware).size()) + " bytes are written"),
                                  HasSubstr("take the jacket off, and unplug the supply")));
  const auto content = board.flash(16384);
  EXPECT_EQ(content, as_written(firmware, content));

  const auto made = make_link("serial:" + std::string(board.port()));
  ASSERT_TRUE(made) << made.error().message;
  JacketLink& link = **made;
  const SteadyClock clock;
  const Timestamp deadline = clock.now() + 20s;
  while (link.status().state != LinkState::armed && clock.now() < deadline) {
    link.poll(clock.now());
    std::this_thread::sleep_for(2ms);
  }
  EXPECT_EQ(link.status().state, LinkState::armed) << link.status().problem;
}

TEST_F(JacketFlash, RefusesTheStockBootloaderOfTheDuemilanoveAndSaysWhyAndWhatToDo) {
  SimulatedBoard board({.bootloader = bootloaders / "atmega/ATmegaBOOT_168_atmega328.hex"});
  const Outcome outcome = flash("--yes --port " + board.port());
  EXPECT_EQ(outcome.code, to_int(ExitCode::device));
  EXPECT_THAT(outcome.text,
              AllOf(HasSubstr("a bootloader 1.16 answers at 57600 baud"), HasSubstr("nothing was written"),
                    HasSubstr("leave the watchdog running"), HasSubstr("--programmer"), HasSubstr("burn optiboot")));
  EXPECT_THAT(board.flash(16384), Each(0xFF));
}

// Why the above is so: a program that tells its start at 57600 baud and then hangs until the watchdog resets the chip.
class AHangingProgram : public JacketFlash {
 protected:
  [[nodiscard]] std::filesystem::path program() const {
    const auto source = folder.write("hangs.c", R"(#include <avr/io.h>
#include <avr/wdt.h>
int main(void) {
  MCUSR = 0;
  wdt_disable();
  UBRR0 = 16;
  UCSR0B = _BV(TXEN0);
  wdt_enable(WDTO_120MS);
  UDR0 = 'S';
  for (;;) {}
})");
    const std::string elf = folder / "hangs.elf";
    const std::string hex = folder / "hangs.hex";
    const std::string compile = "avr-gcc -Os -mmcu=atmega328p " + source.string() + " -o " + elf;
    if (std::system((compile + " && avr-objcopy -O ihex " + elf + " " + hex).c_str()) != 0)
      throw std::runtime_error("the program can't be compiled: run deploy/setup");
    return hex;
  }

  // How often it starts in four seconds of the chip, from when the port is opened.
  static int starts(SimulatedBoard& board) {
    auto port = open_serial_port(board.port(), 57600);
    if (!port) throw std::runtime_error(port.error().message);
    int count = 0;
    const std::uint64_t begin_ms = board.simulated_ms();
    while (board.simulated_ms() < begin_ms + 4000) {
      std::array<std::uint8_t, 64> bytes{};
      const std::size_t size = port->read(bytes).value_or(0);
      count += static_cast<int>(std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size), 'S'));
      std::this_thread::sleep_for(5ms);
    }
    return count;
  }
};

TEST_F(AHangingProgram, IsStartedAgainByOptiboot) {
  SimulatedBoard board({.bootloader = compiled_optiboot("atmega328p", "0x7E00"), .program = program()});
  EXPECT_GT(starts(board), 10);
}

TEST_F(AHangingProgram, NeverStartsAgainWithTheStockBootloader) {
  SimulatedBoard board({.bootloader = bootloaders / "atmega/ATmegaBOOT_168_atmega328.hex", .program = program()});
  EXPECT_EQ(starts(board), 1);
}

TEST_F(JacketFlash, WritesToThePortOfTheConfigurationIfNoneIsNamed) {
  SimulatedBoard board = board_with_optiboot();
  folder.write("telehug/passive.toml", "[jacket]\nlink = \"serial:" + board.port() + "\"\n");
  const Outcome outcome = flash("--yes");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr(board.port()));
}

TEST_F(JacketFlash, AsksForAPortIfNeitherTheConfigurationNorTheCommandLineNamesOne) {
  const Outcome outcome = flash("--yes");
  EXPECT_EQ(outcome.code, to_int(ExitCode::usage));
  EXPECT_THAT(outcome.text, HasSubstr("--port /dev/ttyUSB0"));
}

TEST_F(JacketFlash, TellsThatTheConfigurationIsFaulty) {
  folder.write("telehug/passive.toml", "[jacket]\nlink = 7\n");
  const Outcome outcome = flash("--yes");
  EXPECT_EQ(outcome.code, to_int(ExitCode::config));
  EXPECT_THAT(outcome.text, HasSubstr("passive.toml:2"));
}

TEST_F(JacketFlash, WritesOnlyAfterAYes) {
  SimulatedBoard board = board_with_optiboot();
  const Outcome refused = flash("--port " + board.port(), "echo n |");
  EXPECT_EQ(refused.code, to_int(ExitCode::refused));
  EXPECT_THAT(refused.text, AllOf(HasSubstr("Go on? [y/N]"), HasSubstr("nothing was written")));
  EXPECT_EQ(flash("--port " + board.port() + " </dev/null").code, to_int(ExitCode::refused));
  EXPECT_THAT(board.flash(16384), Each(0xFF));
  EXPECT_EQ(flash("--port " + board.port(), "echo y |").code, 0);
}

TEST_F(JacketFlash, SaysWhoHoldsThePortAndHowToEndThat) {
  SimulatedBoard board = board_with_optiboot();
  const int held = open(board.port().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  ASSERT_EQ(flock(held, LOCK_EX | LOCK_NB), 0);
  const Outcome outcome = flash("--yes --port " + board.port());
  close(held);
  EXPECT_EQ(outcome.code, to_int(ExitCode::device));
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("test_jacket_fla"), HasSubstr("kill " + std::to_string(getpid()))));
  EXPECT_THAT(board.flash(16384), Each(0xFF));
}

TEST_F(JacketFlash, TellsThatTheChipIsAnotherOne) {
  SimulatedBoard board({.chip = "atmega168", .bootloader = compiled_optiboot("atmega168", "0x3E00")});
  const Outcome outcome = flash("--yes --port " + board.port());
  EXPECT_EQ(outcome.code, to_int(ExitCode::device));
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("expected signature for ATmega328P"), HasSubstr("and no other chip")));
  EXPECT_THAT(board.flash(8192), Each(0xFF));
}

TEST_F(JacketFlash, TellsThatTheChipDoesNotKeepWhatIsWritten) {
  SimulatedBoard board = board_with_optiboot(0);
  const Outcome outcome = flash("--yes --port " + board.port());
  EXPECT_EQ(outcome.code, to_int(ExitCode::device));
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("verification mismatch"), HasSubstr("worn out")));
}

TEST_F(JacketFlash, SaysWhatToInstallIfAvrdudeIsMissing) {
  SimulatedBoard board = board_with_optiboot();
  const Outcome outcome = flash("--yes --port " + board.port(), "PATH=/nowhere");
  EXPECT_EQ(outcome.code, to_int(ExitCode::device));
  EXPECT_THAT(outcome.text, HasSubstr("sudo apt install avrdude"));
}

TEST_F(JacketFlash, TakesTheFirmwareOfTheBoard) {
  // Fails at the port at the latest, and names the file before.
  EXPECT_THAT(flash("--yes --port /dev/null").text, HasSubstr(firmware.string()));
  for (const std::string board : {"motors12_heaters2", "legacy"}) {
    const Outcome outcome = flash("--yes --port /dev/null --board " + board);
    EXPECT_EQ(outcome.code, to_int(ExitCode::device));
    EXPECT_THAT(outcome.text, HasSubstr("firmware/telehug-jacket-" + board + ".hex"));
  }
  EXPECT_EQ(flash("--yes --port /dev/null --board legacy --firmware " + firmware.string()).code,
            to_int(ExitCode::usage));
}

TEST_F(JacketFlash, RefusesFilesThatAreNoFirmwareAndPortsThatAreNone) {
  const auto text = folder.write("notes.hex", "not a firmware").string();
  EXPECT_THAT(flash("--yes --port /dev/null --firmware " + text).text, HasSubstr("Intel's hex format"));
  EXPECT_THAT(flash("--yes --port /dev/null --firmware " + text + ".none").text, HasSubstr("can't be read"));
  EXPECT_THAT(flash("--yes --port /dev/null").text, HasSubstr("/dev/null is not a serial port"));
  EXPECT_THAT(flash("--yes --port /dev/ttyNone").text, HasSubstr("plug the board in"));
  EXPECT_EQ(flash("--yes --port /dev/null").code, to_int(ExitCode::device));
  EXPECT_EQ(flash("--yes --port /dev/null --board motors99").code, to_int(ExitCode::usage));
  EXPECT_EQ(flash("--yes --port /dev/null --set-fuses").code, to_int(ExitCode::usage));
  EXPECT_EQ(flash("--yes --programmer arduino --port /dev/null").code, to_int(ExitCode::usage));
}

// As a Duemilanove leaves the factory (boards.txt of the Arduino core).
constexpr std::array<std::uint8_t, 3> factory_fuses{0xFF, 0xDA, 0xFD};

TEST_F(JacketFlash, WritesByAProgrammerIfTheFusesAreRight) {
  IspProgrammer programmer({.fuses = {0xFF, 0xDB, 0xFC}});
  const Outcome outcome = flash("--yes --programmer stk500v1 --port " + programmer.port());
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  const ProgrammedChip chip = programmer.chip();
  EXPECT_TRUE(chip.was_erased);
  EXPECT_EQ(chip.flash, as_written(firmware, std::vector<std::uint8_t>(32768, 0xFF)));
  EXPECT_THAT(chip.fuse_writes, IsEmpty());
}

TEST_F(JacketFlash, WritesNothingOnWrongFusesAndTellsTheCommandThatMendsThem) {
  IspProgrammer programmer({.fuses = factory_fuses});
  const Outcome outcome = flash("--yes --programmer stk500v1 --port " + programmer.port());
  EXPECT_EQ(outcome.code, to_int(ExitCode::device));
  EXPECT_THAT(outcome.text, AllOf(HasSubstr("BOOTRST"), HasSubstr("brown-out"), Not(HasSubstr("CKSEL")),
                                  HasSubstr("avrdude -c stk500v1 -p m328p -P " + programmer.port() +
                                            " -U hfuse:w:0xDB:m -U efuse:w:0xFC:m")));
  const ProgrammedChip chip = programmer.chip();
  EXPECT_THAT(chip.fuse_writes, IsEmpty());
  EXPECT_FALSE(chip.was_erased);
  EXPECT_THAT(chip.flash, Each(0xFF));
  // The command that it told does so.
  const std::size_t begin = outcome.text.find("avrdude -c");
  const std::string command = outcome.text.substr(begin, outcome.text.find('\n', begin) - begin);
  EXPECT_EQ(std::system((command + " >/dev/null 2>&1").c_str()), 0) << command;
  EXPECT_EQ(flash("--yes --programmer stk500v1 --port " + programmer.port()).code, 0);
}

TEST_F(JacketFlash, SetsWrongFusesIfItIsToldTo) {
  IspProgrammer programmer({.fuses = factory_fuses});
  const Outcome outcome = flash("--yes --set-fuses --programmer stk500v1 --port " + programmer.port());
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  const ProgrammedChip chip = programmer.chip();
  // avrdude writes the bits that do not exist as 0.
  EXPECT_THAT(chip.fuse_writes, ElementsAre(ElementsAre(1, 0xDB), ElementsAre(2, 0x04)));
  EXPECT_EQ(chip.flash, as_written(firmware, std::vector<std::uint8_t>(32768, 0xFF)));
}

TEST_F(JacketFlash, WritesNothingIfTheFusesWereNotTaken) {
  IspProgrammer programmer({.fuses = factory_fuses, .takes_fuses = false});
  const Outcome outcome = flash("--yes --set-fuses --programmer stk500v1 --port " + programmer.port());
  EXPECT_EQ(outcome.code, to_int(ExitCode::device));
  EXPECT_THAT(outcome.text, HasSubstr("the fuses were not set"));
  EXPECT_FALSE(programmer.chip().was_erased);
}

TEST_F(JacketFlash, SaysThatAProgrammerIsNotThereOrNotKnown) {
  const Outcome absent = flash("--yes --programmer usbasp");
  EXPECT_EQ(absent.code, to_int(ExitCode::device));
  EXPECT_THAT(absent.text, AllOf(HasSubstr("nothing was written"), HasSubstr("plug the programmer in")));
  EXPECT_THAT(flash("--yes --programmer nonsense").text, HasSubstr("avrdude -c '?'"));
}

}  // namespace
}  // namespace telehug
