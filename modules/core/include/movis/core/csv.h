#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace movis {

// A comma-separated table with a header line. Cells are plain text without quotes, trimmed of spaces. Every row has
// as many cells as the header; anything else is an Error that names file, line and column.
class CsvTable {
 public:
  static CsvTable read(const std::filesystem::path& file);

  const std::filesystem::path& file() const { return file_; }
  const std::vector<std::string>& header() const { return header_; }
  std::size_t rows() const { return rows_.size(); }
  int line(std::size_t row) const { return rows_[row].line; }

  std::optional<std::size_t> find_column(const std::string& name) const;
  std::size_t column(const std::string& name) const;  // throws where it is missing

  const std::string& text(std::size_t row, std::size_t column) const { return rows_[row].cells[column]; }
  double number(std::size_t row, std::size_t column) const;  // a finite number, or an Error
  std::int64_t integer(std::size_t row, std::size_t column) const;

 private:
  struct Row {
    int line;
    std::vector<std::string> cells;
  };
  std::string where(std::size_t row, std::size_t column) const;

  std::filesystem::path file_;
  std::vector<std::string> header_;
  std::vector<Row> rows_;
};

}  // namespace movis
