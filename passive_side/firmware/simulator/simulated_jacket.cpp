// SPDX-License-Identifier: Apache-2.0
#include "simulator/simulated_jacket.hpp"

#include <avr_ioport.h>
#include <avr_uart.h>
#include <sim_avr.h>
#include <sim_cycle_timers.h>
#include <sim_io.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <stdexcept>
#include <utility>

#include "simulator/loaded_elf.hpp"

namespace telehug {
namespace {

constexpr std::array<char, 3> port_names{'B', 'C', 'D'};
constexpr unsigned led_bit = 5;         // of port B
constexpr unsigned timer_clock = 0xB1;  // TCCR2B

// At power-on, RAM holds anything but what a run has left.
constexpr std::uint8_t undefined_ram = 0xA5;

// What the ATmega328P's receiver holds: a two byte FIFO and the shift register.
constexpr unsigned real_uart_depth = 3;

void be_silent(avr_t*, const int level, const char* format, va_list arguments) {
  if (level == LOG_ERROR) std::vfprintf(stderr, format, arguments);
}

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

  const BoardWiring& board;
  std::array<bool, jacket_outputs> high{};
  bool led = false;
  std::uint32_t statics_end = 0;
  std::unique_ptr<HeaterBench> heaters;
  EdgeListener listener;

  struct Hang {
    avr_flashaddr_t at = 0;
    std::array<std::uint8_t, 2> instruction{};
  };
  std::unique_ptr<Hang> hang;

  struct PortListener {
    Machine* machine = nullptr;
    char name = 0;
  };
  std::array<PortListener, port_names.size()> ports;

  Machine(const std::filesystem::path& elf, const BoardWiring& wiring);
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

  void set_heater(std::size_t heater, bool level) {
    set_pin(first_heater_channel + heater, level);
    heaters->set_transistor(heater, level);
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

SimulatedJacket::Machine::Machine(const std::filesystem::path& elf, const BoardWiring& wiring) : board(wiring) {
  avr_global_logger_set(be_silent);
  LoadedElf firmware(elf);
  avr = avr_make_mcu_by_name("atmega328p");
  if (avr == nullptr) throw std::runtime_error("this libsimavr does not know the ATmega328P");
  avr_init(avr);
  firmware.content.frequency = static_cast<std::uint32_t>(jacket_cycles_per_ms * 1000);
  avr_load_firmware(avr, &firmware.content);
  avr->sleep = do_not_sleep;
  std::fill(avr->data + avr->ioend + 1, avr->data + avr->ramend + 1, undefined_ram);
  statics_end = firmware.end_of_statics();

  std::uint32_t flags = 0;
  avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
  uart = find_uart(avr);
  uart_input = avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_INPUT);
  avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT), &Machine::on_output, this);
  for (std::size_t i = 0; i < ports.size(); ++i) {
    ports[i] = {this, port_names[i]};
    avr_irq_t* const pins =
        avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ(static_cast<unsigned>(port_names[i])), IOPORT_IRQ_PIN_ALL);
    avr_irq_register_notify(pins, &Machine::on_port, &ports[i]);
  }
  reset_watcher.kind = "telehug-reset-watcher";
  reset_watcher.reset = &Machine::on_reset;
  avr_register_io(avr, &reset_watcher);
  heaters = std::make_unique<HeaterBench>(avr, board);
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
  const auto& [machine, name] = *static_cast<PortListener*>(port_listener);
  const BoardWiring& board = machine->board;
  const auto is_high = [&](const BoardPin& pin) { return (value >> pin.bit & 1U) != 0; };
  for (std::size_t i = 0; i < board.motors.size(); ++i) {
    if (board.motors[i].port == name) machine->set_pin(i, is_high(board.motors[i]));
  }
  for (std::size_t i = 0; i < board.heaters.size(); ++i) {
    if (board.heaters[i].transistor.port == name) machine->set_heater(i, is_high(board.heaters[i].transistor));
  }
  if (board.heater_supply && board.heater_supply->port == name) {
    machine->heaters->set_supply_transistor(is_high(*board.heater_supply));
  }
  if (name == 'B') machine->led = (value >> led_bit & 1U) != 0;
}

// simavr forgets all timers at a reset, and does not say that the pins fell.
void SimulatedJacket::Machine::on_reset(avr_io_t* io) {
  auto& machine = *reinterpret_cast<Machine*>(io);
  ++machine.resets;
  for (std::size_t channel = 0; channel < jacket_channels; ++channel)
    machine.set_pin(channel, false);
  for (std::size_t heater = 0; heater < machine.board.heaters.size(); ++heater)
    machine.set_heater(heater, false);
  machine.heaters->set_supply_transistor(false);
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

SimulatedJacket::SimulatedJacket(const std::filesystem::path& elf, const BoardWiring& board)
    : machine_(std::make_unique<Machine>(elf, board)) {}
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

HeaterBench& SimulatedJacket::heaters() {
  return *machine_->heaters;
}

std::size_t SimulatedJacket::untouched_ram() const {
  const avr_t* const avr = machine_->avr;
  const std::uint8_t* const statics_end = avr->data + machine_->statics_end;
  const std::uint8_t* const ram_end = avr->data + avr->ramend + 1;
  return static_cast<std::size_t>(
      std::find_if(statics_end, ram_end, [](std::uint8_t byte) { return byte != undefined_ram; }) - statics_end);
}

void SimulatedJacket::stop_timer() {
  avr_t* const avr = machine_->avr;
  const auto& io = avr->io[AVR_DATA_TO_IO(timer_clock)].w;
  io.c(avr, timer_clock, 0, io.param);
}

void SimulatedJacket::reset() {
  avr_reset(machine_->avr);
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
