/* SPDX-License-Identifier: Apache-2.0 */
/* Of avr-libc what the firmware's board.hpp needs to build on the host. Nothing is behind the ports. */
#pragma once

#include <stdint.h>

enum { PB0, PB1, PB2, PB3, PB4, PB5 };
enum { PC0, PC1, PC2, PC3, PC4, PC5 };
enum { PD0, PD1, PD2 };
enum { ISC01 = 1, ISC11 = 3 };

inline uint8_t PORTB, PORTC, PORTD, DDRB, DDRC, DDRD, EICRA;
