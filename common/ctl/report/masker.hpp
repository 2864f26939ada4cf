// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace telehug {

// Takes out of a text what is nobody else's business.
class Masker {
 public:
  // This text becomes "[word]" wherever it stands by itself. Nothing that is shorter than two bytes, nor what every PC
  // has ("root", "telehug", "localhost").
  void hide(std::string_view secret, std::string word);

  // Without the hidden texts, and without what looks like an address (of the network, Bluetooth or e-mail), a pairing
  // code, a link to the pages, a key, an id, a device's serial number or a person's folder.
  [[nodiscard]] std::string mask(std::string_view text) const;

  // The same for what people may have written into: also without texts in quotes and without reasons.
  [[nodiscard]] std::string mask_free_text(std::string_view text) const;

 private:
  [[nodiscard]] std::string mask_lines(std::string_view text, bool free_text) const;
  [[nodiscard]] std::string mask_line(std::string line, bool free_text) const;

  // Longest first: of "Mia Meier" nothing is left.
  struct Longer {
    bool operator()(const std::string& a, const std::string& b) const {
      return a.size() != b.size() ? a.size() > b.size() : a < b;
    }
  };
  std::map<std::string, std::string, Longer> hidden_;
};

}  // namespace telehug
