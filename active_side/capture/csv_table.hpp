// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace telehug {

// A comma-separated file as recordings use them: a header line that names the columns, no quoting (no value of ours
// holds a comma). Faults are collected as "file:line: what" and reading goes on, so that all of them are told at once.
class CsvTable {
 public:
  // A file that can't be read, a missing column and a row with too few or too many values are faults; such rows are
  // left out. Of the `optional` columns, which are counted after `columns`, those that are missing are empty in all
  // rows. Further columns are ignored.
  CsvTable(const std::filesystem::path& path, const std::vector<std::string>& columns, std::vector<std::string>& faults,
           const std::vector<std::string>& optional = {});

  [[nodiscard]] std::size_t rows() const noexcept { return rows_.size(); }

  // The text of a cell without surrounding blanks; `column` counts in the order given to the constructor.
  [[nodiscard]] std::string_view text(std::size_t row, std::size_t column) const { return rows_[row].cells[column]; }

  // A finite number, or nullopt and a fault. An empty cell is a fault, too: ask text() first where it may be empty.
  [[nodiscard]] std::optional<double> number(std::size_t row, std::size_t column);
  [[nodiscard]] std::optional<std::int64_t> integer(std::size_t row, std::size_t column);

  void add_fault(std::size_t row, std::string_view what);

 private:
  struct Row {
    int line = 0;
    std::vector<std::string> cells;
  };

  void add_line_fault(int line, std::string_view what);

  std::filesystem::path path_;
  std::vector<std::string> columns_;
  std::vector<std::string>& faults_;
  std::vector<Row> rows_;
};

}  // namespace telehug
