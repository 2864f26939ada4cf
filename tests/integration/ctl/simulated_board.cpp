// SPDX-License-Identifier: Apache-2.0
#include "integration/ctl/simulated_board.hpp"

#include <avr_extint.h>
#include <avr_uart.h>
#include <poll.h>
#include <sim_avr.h>
#include <sim_io.h>
#include <sim_regbit.h>
#include <termios.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <stdexcept>

#include "common/clock.hpp"
#include "integration/ctl/intel_hex.hpp"
#include "simulator/pty_bridge.hpp"

namespace telehug {
namespace {

constexpr std::uint32_t clock_hz = 16'000'000;
constexpr std::size_t line_bytes_max = 64;  // the rest waits in the terminal
constexpr Duration lag_max = 20ms;          // lost time beyond this is dropped, not caught up with

void be_silent(avr_t*, const int, const char*, va_list) {}
void do_not_sleep(avr_t*, avr_cycle_count_t) {}

unsigned baud_of(speed_t code) {
  switch (code) {
    case B57600:
      return 57600;
    case B115200:
      return 115200;
    default:
      return 0;
  }
}

}  // namespace

struct SimulatedBoard::Chip {
  explicit Chip(BoardOptions chosen) : options(std::move(chosen)), pty({}) {
    avr_global_logger_set(be_silent);
    avr = avr_make_mcu_by_name(options.chip.c_str());
    if (avr == nullptr) throw std::runtime_error("simavr knows no " + options.chip);
    avr_init(avr);
    avr->frequency = clock_hz;
    avr->sleep = do_not_sleep;
    load_bootloader();
    std::uint32_t flags = 0;
    avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
    for (avr_io_t* io = avr->io_port; io != nullptr; io = io->next)
      if (std::strcmp(io->kind, "uart") == 0) uart = reinterpret_cast<avr_uart_t*>(io);
    input = avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_INPUT);
    avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT), &Chip::on_output, this);
    reset();
  }
  ~Chip() {
    avr_terminate(avr);
    std::free(avr);
  }
  Chip(const Chip&) = delete;
  Chip& operator=(const Chip&) = delete;

  void load_bootloader() {
    const auto bytes = read_intel_hex(options.bootloader);
    if (bytes.rbegin()->first > avr->flashend) {
      throw std::runtime_error(options.bootloader.string() + " is too big for an " + options.chip);
    }
    for (const auto& [address, byte] : bytes)
      avr->flash[address] = byte;
    boot_start = bytes.begin()->first;
    // The BOOTRST fuse of these boards is programmed.
    avr->reset_pc = boot_start;
    avr->codeend = avr->flashend;
  }

  void reset() {
    avr_reset(avr);
    avr->state = cpu_Running;
    avr->pc = boot_start;
    avr_regbit_clear(avr, avr->reset_flags.porf);
    avr_regbit_set(avr, avr->reset_flags.extrf);
    line.clear();
  }

  // simavr counts 11 bits a byte.
  [[nodiscard]] bool hears() const {
    const auto chip_baud =
        uart->cycles_per_byte == 0 ? 0 : 11.0 * clock_hz / static_cast<double>(uart->cycles_per_byte);
    return std::abs(chip_baud - host_baud) < 0.05 * chip_baud;
  }
  [[nodiscard]] std::uint8_t on_the_line(std::uint8_t byte) const {
    return hears() ? byte : static_cast<std::uint8_t>(~byte);
  }

  static void on_output(avr_irq_t*, std::uint32_t value, void* self) {
    auto& chip = *static_cast<Chip*>(self);
    const std::uint8_t byte = chip.on_the_line(static_cast<std::uint8_t>(value));
    chip.pty.write({&byte, 1});
  }

  void look_at_the_port() {
    termios settings{};
    if (tcgetattr(pty.fd(), &settings) == 0) {
      const unsigned baud = baud_of(cfgetospeed(&settings));
      if (baud != host_baud && baud != 0) reset();
      host_baud = baud;
    }
    if (line.size() >= line_bytes_max) return;
    const auto bytes = pty.read();
    line.insert(line.end(), bytes.begin(), bytes.end());
  }

  // As long as a byte takes on the line.
  void run_a_byte_time() {
    if (!line.empty()) {
      avr_raise_irq(input, on_the_line(line.front()));
      line.pop_front();
    }
    // Otherwise simavr looks at these pins in every cycle.
    avr_extint_set_strict_lvl_trig(avr, 0, 0);
    avr_extint_set_strict_lvl_trig(avr, 1, 0);
    const avr_cycle_count_t end = avr->cycle + std::max<avr_cycle_count_t>(uart->cycles_per_byte, 1000);
    while (avr->cycle < end) {
      if (const int state = avr_run(avr); state == cpu_Crashed || state == cpu_Done) {
        avr->cycle = end;  // stands still until the next reset
      }
    }
    if (options.worn_cell) avr->flash[*options.worn_cell] = 0xFF;
  }

  BoardOptions options;
  PtyBridge pty;
  avr_t* avr = nullptr;
  avr_uart_t* uart = nullptr;
  avr_irq_t* input = nullptr;
  std::uint32_t boot_start = 0;
  unsigned host_baud = 0;
  std::deque<std::uint8_t> line;
};

SimulatedBoard::SimulatedBoard(BoardOptions options)
    : chip_(std::make_unique<Chip>(std::move(options))), thread_([this] { run(); }) {}

SimulatedBoard::~SimulatedBoard() {
  ends_ = true;
  thread_.join();
}

std::string SimulatedBoard::port() const {
  return chip_->pty.path();
}

std::vector<std::uint8_t> SimulatedBoard::flash(std::size_t size) {
  const std::lock_guard lock(mutex_);
  return {chip_->avr->flash, chip_->avr->flash + size};
}

void SimulatedBoard::run() {
  const SteadyClock clock;
  Timestamp epoch = clock.now();
  avr_cycle_count_t epoch_cycle = chip_->avr->cycle;
  const auto simulated = [&] { return epoch + std::chrono::nanoseconds((chip_->avr->cycle - epoch_cycle) * 125 / 2); };
  while (!ends_) {
    {
      const std::lock_guard lock(mutex_);
      chip_->look_at_the_port();
      // A reset begins the count of cycles anew in some versions of simavr.
      if (chip_->avr->cycle < epoch_cycle || clock.now() - simulated() > lag_max) {
        epoch = clock.now();
        epoch_cycle = chip_->avr->cycle;
      }
      for (int bytes = 0; bytes < 20 && simulated() < clock.now() + 1ms; ++bytes)
        chip_->run_a_byte_time();
    }
    std::this_thread::sleep_until(simulated());
  }
}

}  // namespace telehug
