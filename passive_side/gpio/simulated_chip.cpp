// SPDX-License-Identifier: Apache-2.0
#include "gpio/simulated_chip.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

#include "gpio/debounced_input.hpp"
#include "gpio/gpio_error.hpp"

namespace telehug {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int fd) noexcept : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) close(fd_);
  }
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const noexcept { return fd_; }

 private:
  int fd_;
};

// The file of a line, locked by its owner.
class LineFile {
 public:
  static Result<LineFile> take(const std::filesystem::path& folder, const std::string& name, int mode) {
    LineFile file(folder, name, mode);
    if (file.fd_.get() < 0) return file.error(errno);
    if (flock(file.fd_.get(), LOCK_EX | LOCK_NB) != 0) return file.error(errno == EWOULDBLOCK ? EBUSY : errno);
    return file;
  }

  [[nodiscard]] std::filesystem::path path() const { return folder_ / name_; }
  [[nodiscard]] Error error(int code) const { return line_error("simulated:" + folder_.string(), name_, code); }

  [[nodiscard]] Result<bool> high() const {
    struct stat status {};
    if (fstat(fd_.get(), &status) != 0) return error(errno);
    if (status.st_nlink == 0) return error(ENODEV);
    char level = '0';
    if (pread(fd_.get(), &level, 1, 0) < 0) return error(errno);
    return level == '1';
  }

  [[nodiscard]] Status write(bool high) const {
    struct stat status {};
    if (fstat(fd_.get(), &status) != 0) return error(errno);
    if (status.st_nlink == 0) return error(ENODEV);
    const std::array<char, 2> text{high ? '1' : '0', '\n'};
    if (pwrite(fd_.get(), text.data(), text.size(), 0) != static_cast<ssize_t>(text.size())) return error(errno);
    return Done{};
  }

 private:
  LineFile(const std::filesystem::path& folder, const std::string& name, int mode)
      : folder_(folder), name_(name), fd_(open((folder / name).c_str(), mode | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK)) {}

  std::filesystem::path folder_;
  std::string name_;
  Descriptor fd_;
};

class Input final : public InputLine {
 public:
  Input(LineFile file, Descriptor changes, bool active_low)
      : file_(std::move(file)), changes_(std::move(changes)), active_low_(active_low) {}

  [[nodiscard]] int fd() const noexcept override { return changes_.get(); }

  [[nodiscard]] Result<std::optional<LevelChange>> next(Timestamp now) override {
    std::array<char, 4096> notes{};
    const ssize_t size = read(changes_.get(), notes.data(), notes.size());
    if (size < 0 && errno != EAGAIN && errno != EINTR) return file_.error(errno);
    if (size <= 0) return std::optional<LevelChange>();
    const auto level = this->level();
    if (!level) return level.error();
    return std::optional(LevelChange{now, *level});
  }

  [[nodiscard]] Result<bool> level() override {
    const auto high = file_.high();
    if (!high) return high;
    return *high != active_low_;
  }

 private:
  LineFile file_;
  Descriptor changes_;
  bool active_low_;
};

class Output final : public OutputLine {
 public:
  Output(LineFile file, bool active_low) : file_(std::move(file)), active_low_(active_low) {}
  ~Output() override { (void)set(false); }

  [[nodiscard]] Status set(bool active) override { return file_.write(active != active_low_); }

 private:
  LineFile file_;
  bool active_low_;
};

class Chip final : public GpioChip {
 public:
  explicit Chip(std::filesystem::path folder) : folder_(std::move(folder)) {}

  [[nodiscard]] Result<std::unique_ptr<InputLine>> input(const std::string& name,
                                                         const InputOptions& options) override {
    auto file = LineFile::take(folder_, name, O_RDONLY);
    if (!file) return file.error();
    Descriptor changes(inotify_init1(IN_NONBLOCK | IN_CLOEXEC));
    if (changes.get() < 0) return file->error(errno);
    if (inotify_add_watch(changes.get(), file->path().c_str(), IN_MODIFY | IN_ATTRIB | IN_DELETE_SELF) < 0)
      return file->error(errno);
    std::unique_ptr<InputLine> line = std::make_unique<Input>(*std::move(file), std::move(changes), options.active_low);
    const auto level = line->level();
    if (!level) return level.error();
    if (options.debounce == Duration::zero()) return line;
    return std::unique_ptr<InputLine>(std::make_unique<DebouncedInput>(std::move(line), options.debounce, *level));
  }

  [[nodiscard]] Result<std::unique_ptr<OutputLine>> output(const std::string& name, bool active_low) override {
    auto file = LineFile::take(folder_, name, O_RDWR);
    if (!file) return file.error();
    auto line = std::make_unique<Output>(*std::move(file), active_low);
    if (const auto set = line->set(false); !set) return set.error();
    return std::unique_ptr<OutputLine>(std::move(line));
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace

Result<std::unique_ptr<GpioChip>> open_simulated_chip(const std::filesystem::path& folder) {
  std::error_code failed;
  if (!std::filesystem::is_directory(folder, failed)) return chip_error("simulated:" + folder.string(), ENOENT);
  return std::unique_ptr<GpioChip>(std::make_unique<Chip>(folder));
}

}  // namespace telehug
