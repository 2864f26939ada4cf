// SPDX-License-Identifier: Apache-2.0
//
// The code that one person reads to the other: any text; and real codes, written as people write.
#include <algorithm>
#include <cstdlib>

#include "fuzz/bytes.hpp"
#include "pairing_link/pairing_code.hpp"

namespace telehug {
namespace {

bool same(const PairingCode& a, const PairingCode& b) {
  return a.secret == b.secret && a.inviter.address == b.inviter.address && a.inviter.port == b.inviter.port;
}

// What was read is printed in one way, and is read from that as the same.
void read(const std::string& text) {
  const auto code = parse_pairing_code(text);
  if (!code) return;
  const std::string printed = to_text(*code);
  const auto again = parse_pairing_code(printed);
  if (!again || !same(*again, *code) || to_text(*again) != printed || code->inviter.port == 0) std::abort();
}

// Small letters, letters for digits, blanks and dashes: as the input says.
std::string written_down(const std::string& code, Bytes& bytes) {
  std::string text;
  for (char letter : code) {
    const std::uint8_t how = bytes.byte();
    if ((how & 1U) != 0 && letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    if ((how & 2U) != 0 && letter == '0') letter = 'o';
    if ((how & 2U) != 0 && letter == '1') letter = (how & 4U) != 0 ? 'L' : 'i';
    if (letter != '-' || (how & 8U) == 0) text += letter;
    if ((how & 16U) != 0) text += " -\t\r\n"[how % 5];
  }
  return text;
}

void read_real_code(Bytes& bytes) {
  PairingCode code;
  std::generate(code.secret.begin(), code.secret.end(), [&] { return bytes.byte(); });
  std::generate(code.inviter.address.begin(), code.inviter.address.end(), [&] { return bytes.byte(); });
  code.inviter.port = bytes.number<std::uint16_t>();
  const auto read_again = parse_pairing_code(written_down(to_text(code), bytes));
  if (read_again.ok() != (code.inviter.port != 0)) std::abort();
  if (read_again && !same(*read_again, code)) std::abort();
}

}  // namespace
}  // namespace telehug

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  telehug::Bytes bytes(data, size);
  if (bytes.byte() % 2 == 0) {
    telehug::read(bytes.rest());
  } else {
    telehug::read_real_code(bytes);
  }
  return 0;
}
