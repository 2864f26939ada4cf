// SPDX-License-Identifier: Apache-2.0
//
// Changes to a PEM or S/MIME text that a fuzzer's input describes. The keys in it are new in every run, so that an
// input can't hold the text itself; and what is changed within the Base64 gets to the parser behind it.
#pragma once

#include <openssl/evp.h>

#include <algorithm>
#include <string>
#include <vector>

#include "fuzz/bytes.hpp"

namespace telehug {

// Where the Base64 of the last block lies: between the last blank line or BEGIN line and the line that ends it.
struct Base64Block {
  std::size_t begin = 0;
  std::size_t end = 0;
};

inline Base64Block base64_block(const std::string& text) {
  const auto of_base64 = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '+' || c == '/' ||
           c == '=';
  };
  const std::size_t last = text.rfind("\n--");
  if (last == std::string::npos) return {};
  Base64Block block{last, last};
  while (block.end > 0 && text[block.end - 1] == '\n')
    --block.end;
  block.begin = block.end;
  while (block.begin > 0 && (of_base64(text[block.begin - 1]) || text[block.begin - 1] == '\n'))
    --block.begin;
  while (block.begin < block.end && text[block.begin] == '\n')
    ++block.begin;
  return block;
}

// Bytes that a chain of edits in `bytes` makes of the given ones: an edit is its kind, its place, and a value.
inline std::string edited(std::string content, Bytes& bytes, std::size_t most_edits) {
  for (std::size_t i = 0; i < most_edits && !bytes.empty(); ++i) {
    const std::uint8_t kind = bytes.byte();
    const std::size_t at = bytes.below(content.size() + 1);
    switch (kind % 6) {
      case 0:
        if (at < content.size()) content[at] = static_cast<char>(bytes.byte());
        break;
      case 1:
        if (at < content.size()) content[at] = static_cast<char>(content[at] ^ (1 << bytes.byte() % 8));
        break;
      case 2:
        content.insert(at, bytes.text(bytes.byte() % 16U));
        break;
      case 3:
        content.erase(at, bytes.byte());
        break;
      case 4:
        content.insert(at, content.substr(0, bytes.number<std::uint16_t>()));
        break;
      default:
        content.resize(at);
        break;
    }
  }
  return content;
}

// The same within the Base64, whose lines are then as OpenSSL writes them.
inline std::string edited_within_base64(const std::string& text, Bytes& bytes, std::size_t most_edits) {
  const Base64Block block = base64_block(text);
  std::string base64 = text.substr(block.begin, block.end - block.begin);
  std::erase(base64, '\n');
  std::vector<unsigned char> raw(base64.size() / 4 * 3 + 3);
  const int size = EVP_DecodeBlock(raw.data(), reinterpret_cast<const unsigned char*>(base64.data()),
                                   static_cast<int>(base64.size()));
  if (size < 0) return text;
  const auto padding = std::count(base64.begin(), base64.end(), '=');
  const std::string content = edited(std::string(raw.begin(), raw.begin() + size - padding), bytes, most_edits);
  std::vector<unsigned char> again(4 * ((content.size() + 2) / 3) + 1);
  const int length = EVP_EncodeBlock(again.data(), reinterpret_cast<const unsigned char*>(content.data()),
                                     static_cast<int>(content.size()));
  std::string lines;
  for (int at = 0; at < length; at += 64) {
    if (at > 0) lines += '\n';
    lines.append(again.begin() + at, again.begin() + std::min(at + 64, length));
  }
  return text.substr(0, block.begin) + lines + text.substr(block.end);
}

}  // namespace telehug
