// SPDX-License-Identifier: Apache-2.0
#include "simulator/simulated_jacket.hpp"

#include <avr_ioport.h>
#include <avr_uart.h>
#include <sim_avr.h>
#include <sim_cycle_timers.h>
#include <sim_elf.h>
#include <sim_io.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <stdexcept>
#include <utility>

namespace telehug {
namespace {

// The wiring as README.md of the firmware shows it, on purpose not shared with the firmware's own table.
struct PortWiring {
  char port;
  std::uint8_t first_bit;
  std::uint8_t first_channel;
  std::uint8_t channels;
};
constexpr std::array<PortWiring, 3> wiring{{{'D', 2, 0, 6}, {'B', 0, 6, 5}, {'C', 0, 11, 5}}};
constexpr unsigned led_bit = 5;  // of port B

// What the ATmega328P's receiver holds: a two byte FIFO and the shift register.
constexpr unsigned real_uart_depth = 3;

void be_silent(avr_t*, const int level, const char* format, va_list arguments) {
  if (level == LOG_ERROR) std::vfprintf(stderr, format, arguments);
}

// What elf_read_firmware() has allocated and avr_load_firmware() has copied; libsimavr itself never frees it.
struct LoadedElf {
  elf_firmware_t content{};

  LoadedElf() = default;
  ~LoadedElf() {
    std::free(content.flash);
    std::free(content.eeprom);
    std::free(content.fuse);
    std::free(content.lockbits);
    for (std::uint32_t i = 0; i < content.symbolcount; ++i)
      std::free(content.symbol[i]);
    std::free(static_cast<void*>(content.symbol));
  }
  LoadedElf(const LoadedElf&) = delete;
  LoadedElf& operator=(const LoadedElf&) = delete;
};

void do_not_sleep(avr_t*, avr_cycle_count_t) {}

avr_cycle_count_t stop_here(avr_t*, avr_cycle_count_t, void*) {
  return 0;
}

avr_uart_t* find_uart(avr_t* avr) {
  for (avr_io_t* io = avr->io_port; io != nullptr; io = io->next) {
    if (std::strcmp(io->kind, "uart") == 0) return reinterpret_cast<avr_uart_t*>(io);
  }
  throw std::runtime_error("this libsimavr has no UART for the ATmega328P; telehug needs version 1.6");
}

}  // namespace

struct SimulatedJacket::Machine {
  // Told of resets as a peripheral of the chip; must stay first, simavr gives back its address.
  avr_io_t reset_watcher{};
  avr_t* avr = nullptr;
  avr_uart_t* uart = nullptr;
  avr_irq_t* uart_input = nullptr;

  std::deque<std::uint8_t> line;
  bool feeding = false;
  bool muted = false;
  avr_cycle_count_t corrected_cycles_per_byte = 0;
  std::uint64_t overruns = 0;
  std::uint64_t resets = 0;
  std::vector<std::uint8_t> output;

  std::array<bool, jacket_channels> high{};
  bool led = false;
  EdgeListener listener;

  struct Hang {
    avr_flashaddr_t at = 0;
    std::array<std::uint8_t, 2> instruction{};
  };
  std::unique_ptr<Hang> hang;

  struct PortListener {
    Machine* machine = nullptr;
    PortWiring wires{};
  };
  std::array<PortListener, wiring.size()> ports;

  explicit Machine(const std::filesystem::path& elf);
  ~Machine() {
    avr_terminate(avr);
    std::free(avr);
  }
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  void set_pin(std::size_t channel, bool level) {
    if (high[channel] == level) return;
    high[channel] = level;
    if (listener) listener({avr->cycle, static_cast<std::uint8_t>(channel), level});
  }

  // simavr counts 11 bits for 8N1 where the wire has 10.
  void correct_byte_time() {
    if (uart->cycles_per_byte == corrected_cycles_per_byte) return;
    corrected_cycles_per_byte = uart->cycles_per_byte * 10 / 11;
    uart->cycles_per_byte = corrected_cycles_per_byte;
  }

  avr_cycle_count_t byte_time() const { return std::max<avr_cycle_count_t>(uart->cycles_per_byte, 100); }

  void feed() {
    if (feeding || line.empty()) return;
    feeding = true;
    avr_cycle_timer_register(avr, byte_time(), &Machine::on_byte_time, this);
  }

  static avr_cycle_count_t on_byte_time(avr_t*, avr_cycle_count_t when, void* self);
  static void on_output(avr_irq_t*, std::uint32_t value, void* self) {
    static_cast<Machine*>(self)->output.push_back(static_cast<std::uint8_t>(value));
  }
  static void on_port(avr_irq_t*, std::uint32_t value, void* port_listener);
  static void on_reset(avr_io_t* io);
  void step();
};

SimulatedJacket::Machine::Machine(const std::filesystem::path& elf) {
  avr_global_logger_set(be_silent);
  LoadedElf firmware;
  if (elf_read_firmware(elf.c_str(), &firmware.content) != 0) {
    throw std::runtime_error("can't read the firmware " + elf.string() + ": build it, or name another with --firmware");
  }
  avr = avr_make_mcu_by_name("atmega328p");
  if (avr == nullptr) throw std::runtime_error("this libsimavr does not know the ATmega328P");
  avr_init(avr);
  firmware.content.frequency = static_cast<std::uint32_t>(jacket_cycles_per_ms * 1000);
  avr_load_firmware(avr, &firmware.content);
  avr->sleep = do_not_sleep;

  std::uint32_t flags = 0;
  avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
  uart = find_uart(avr);
  uart_input = avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_INPUT);
  avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT), &Machine::on_output, this);
  for (std::size_t i = 0; i < wiring.size(); ++i) {
    ports[i] = {this, wiring[i]};
    avr_irq_t* const pins =
        avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ(static_cast<unsigned>(wiring[i].port)), IOPORT_IRQ_PIN_ALL);
    avr_irq_register_notify(pins, &Machine::on_port, &ports[i]);
  }
  reset_watcher.kind = "telehug-reset-watcher";
  reset_watcher.reset = &Machine::on_reset;
  avr_register_io(avr, &reset_watcher);
}

avr_cycle_count_t SimulatedJacket::Machine::on_byte_time(avr_t*, avr_cycle_count_t when, void* self) {
  auto& machine = *static_cast<Machine*>(self);
  machine.correct_byte_time();
  const std::uint8_t byte = machine.line.front();
  machine.line.pop_front();
  const unsigned depth =
      static_cast<unsigned>(machine.uart->input.write - machine.uart->input.read) % uart_fifo_fifo_size;
  if (depth >= real_uart_depth) {
    ++machine.overruns;
  } else {
    avr_raise_irq(machine.uart_input, byte);
  }
  machine.feeding = !machine.line.empty();
  return machine.feeding ? when + machine.byte_time() : 0;
}

void SimulatedJacket::Machine::on_port(avr_irq_t*, std::uint32_t value, void* port_listener) {
  const auto& [machine, wires] = *static_cast<PortListener*>(port_listener);
  for (std::size_t i = 0; i < wires.channels; ++i) {
    machine->set_pin(wires.first_channel + i, (value >> (wires.first_bit + i) & 1U) != 0);
  }
  if (wires.port == 'B') machine->led = (value >> led_bit & 1U) != 0;
}

// simavr forgets all timers at a reset, and does not say that the pins fell.
void SimulatedJacket::Machine::on_reset(avr_io_t* io) {
  auto& machine = *reinterpret_cast<Machine*>(io);
  ++machine.resets;
  for (std::size_t channel = 0; channel < jacket_channels; ++channel)
    machine.set_pin(channel, false);
  machine.led = false;
  machine.corrected_cycles_per_byte = 0;
  if (machine.hang) {
    std::ranges::copy(machine.hang->instruction, machine.avr->flash + machine.hang->at);
    machine.hang.reset();
  }
  machine.feeding = false;
  machine.feed();
}

void SimulatedJacket::Machine::step() {
  const int state = avr_run(avr);
  if (state == cpu_Crashed || state == cpu_Done) throw std::runtime_error("the simulated firmware has crashed");
}

SimulatedJacket::SimulatedJacket(const std::filesystem::path& elf) : machine_(std::make_unique<Machine>(elf)) {}
SimulatedJacket::~SimulatedJacket() = default;

void SimulatedJacket::run_cycles(std::uint64_t cycles) {
  avr_t* const avr = machine_->avr;
  const std::uint64_t end = avr->cycle + cycles;
  while (avr->cycle < end) {
    // Wakes the sleeping core at the end, or after a slice short enough to see a change of the baud rate.
    const std::uint64_t slice_end = std::min(end, avr->cycle + jacket_cycles_per_ms / 4);
    avr_cycle_timer_register(avr, slice_end - avr->cycle, stop_here, this);
    while (avr->cycle < slice_end)
      machine_->step();
    machine_->correct_byte_time();
  }
}

std::uint64_t SimulatedJacket::cycle() const {
  return machine_->avr->cycle;
}

void SimulatedJacket::write(std::span<const std::uint8_t> bytes) {
  if (machine_->muted) return;
  machine_->line.insert(machine_->line.end(), bytes.begin(), bytes.end());
  machine_->feed();
}

std::size_t SimulatedJacket::bytes_in_flight() const {
  return machine_->line.size();
}

std::vector<std::uint8_t> SimulatedJacket::take_output() {
  return std::exchange(machine_->output, {});
}

void SimulatedJacket::mute_input(bool muted) {
  machine_->muted = muted;
  if (muted) machine_->line.clear();
  // The timer that runs for the byte on the way finds the line empty otherwise.
  if (muted && machine_->feeding) {
    avr_cycle_timer_cancel(machine_->avr, &Machine::on_byte_time, machine_.get());
    machine_->feeding = false;
  }
}

void SimulatedJacket::on_edge(EdgeListener listener) {
  machine_->listener = std::move(listener);
}
bool SimulatedJacket::is_high(std::uint8_t channel) const {
  return machine_->high.at(channel);
}
bool SimulatedJacket::armed_led() const {
  return machine_->led;
}
std::uint64_t SimulatedJacket::uart_overruns() const {
  return machine_->overruns;
}
std::uint64_t SimulatedJacket::resets() const {
  return machine_->resets;
}

void SimulatedJacket::hang_main_loop() {
  avr_t* const avr = machine_->avr;
  while (avr->sreg[S_I] == 0)
    machine_->step();  // not in an interrupt
  auto hang = std::make_unique<Machine::Hang>();
  hang->at = avr->pc;
  std::copy_n(avr->flash + avr->pc, hang->instruction.size(), hang->instruction.begin());
  machine_->hang = std::move(hang);
  avr->flash[avr->pc] = 0xFF;  // rjmp .-2
  avr->flash[avr->pc + 1] = 0xCF;
}

}  // namespace telehug
