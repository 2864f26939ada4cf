// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "doubles/temporary_folder.hpp"

namespace telehug {

// What doctor has to say of a set-up.
struct Diagnosis {
  std::string set_up;  // for the table
  std::string level;   // "fail", "warn"
  std::string check;
  std::string what;  // a part of the sentence
  std::string fix;   // likewise
};

// A PC on which nothing is wrong; each test breaks one thing. The devices are files below root(), processes and sockets
// are real.
class BrokenPc : public testing::Test {
 protected:
  BrokenPc();
  // The table of all set-ups.
  static void TearDownTestSuite();

  [[nodiscard]] std::filesystem::path root() const { return folder_ / "root"; }
  [[nodiscard]] std::filesystem::path runtime() const { return folder_ / "run"; }
  [[nodiscard]] std::filesystem::path state() const { return folder_ / "state/telehug"; }
  void write(const std::string& file, const std::string& content) const { folder_.write(file, content); }
  void configure(const std::string& side, const std::string& toml) const {
    write("config/telehug/" + side + ".toml", toml);
  }
  // For doctor and every program of start(): "NAME=value".
  void set(const std::string& variable) { variables_.push_back(variable); }
  [[nodiscard]] const std::vector<std::string>& variables() const { return variables_; }

  // Runs doctor on this side, by way of `before` ("unshare -n sh -c 'nft ...; exec \"$@\"' sh"). It names what is wrong
  // with the fix, and fails in nothing else.
  void expect(const std::string& side, const Diagnosis& diagnosis);
  // Doctor's options beside.
  std::string options;
  std::string before;
  bool as_nobody = false;

 private:
  [[nodiscard]] nlohmann::json ask(const std::string& side, int& code) const;

  TemporaryFolder folder_;
  std::vector<std::string> variables_;
};

}  // namespace telehug
