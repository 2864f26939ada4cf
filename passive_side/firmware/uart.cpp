// SPDX-License-Identifier: Apache-2.0
#include "uart.hpp"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <util/atomic.h>

namespace {

// Both sizes are powers of two, so that an index wraps by masking. 128 bytes are 22 ms of the line at 57600 baud.
constexpr uint8_t rx_size = 128;
constexpr uint8_t tx_size = 64;

volatile uint8_t rx_ring[rx_size];
volatile uint8_t rx_head = 0;
volatile uint8_t rx_tail = 0;
volatile uint8_t tx_ring[tx_size];
volatile uint8_t tx_head = 0;
volatile uint8_t tx_tail = 0;
volatile uint16_t lost_bytes = 0;

constexpr uint16_t baud_divisor = (F_CPU / 4 / TELEHUG_BAUD - 1) / 2;  // double speed: F_CPU / 8 / baud - 1, rounded

}  // namespace

ISR(USART_RX_vect) {
  if (UCSR0A & (1 << DOR0)) lost_bytes = lost_bytes + 1;
  const uint8_t byte = UDR0;
  const uint8_t next = (rx_head + 1) & (rx_size - 1);
  if (next == rx_tail) {
    lost_bytes = lost_bytes + 1;
  } else {
    rx_ring[rx_head] = byte;
    rx_head = next;
  }
}

ISR(USART_UDRE_vect) {
  if (tx_head == tx_tail) {
    UCSR0B &= static_cast<uint8_t>(~(1 << UDRIE0));
  } else {
    UDR0 = tx_ring[tx_tail];
    tx_tail = (tx_tail + 1) & (tx_size - 1);
  }
}

namespace uart {

void init() {
  // In this order: simavr takes the rate from U2X and the frame format at the moment UBRR0L is written.
  UCSR0A = 1 << U2X0;
  UCSR0C = (1 << UCSZ01) | (1 << UCSZ00);
  UBRR0H = baud_divisor >> 8;
  UBRR0L = baud_divisor & 0xFF;
  UCSR0B = (1 << RXCIE0) | (1 << RXEN0) | (1 << TXEN0);
}

bool read(uint8_t& byte) {
  if (rx_head == rx_tail) return false;
  byte = rx_ring[rx_tail];
  rx_tail = (rx_tail + 1) & (rx_size - 1);
  return true;
}

bool has_room(uint8_t length) {
  const uint8_t used = (tx_head - tx_tail) & (tx_size - 1);
  return length < tx_size - used;
}

void write(uint8_t byte) {
  tx_ring[tx_head] = byte;
  tx_head = (tx_head + 1) & (tx_size - 1);
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    UCSR0B |= 1 << UDRIE0;
  }
}

uint16_t overruns() {
  uint16_t count = 0;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    count = lost_bytes;
  }
  return count;
}

}  // namespace uart
