// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
<<<<<<< HEAD

namespace telehug {

// A folder of a test's own that goes away with the test.
=======
#include <string_view>

namespace telehug {

// A folder of its own for one test; it goes with the test.
>>>>>>> capture
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "telehug-test-XXXXXX").string();
<<<<<<< HEAD
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder can be made");
=======
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("can't make " + name);
>>>>>>> capture
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
<<<<<<< HEAD

  // Writes a file below it, with its folders.
  std::filesystem::path write(const std::filesystem::path& name, const std::string& content) const {
    const auto file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << content;
    return file;
=======
  [[nodiscard]] std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

  void write(std::string_view name, std::string_view content) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << content;
>>>>>>> capture
  }

 private:
  std::filesystem::path path_;
};

}  // namespace telehug
