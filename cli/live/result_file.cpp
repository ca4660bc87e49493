// SPDX-License-Identifier: Apache-2.0
#include "cli/live/result_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "base/output.h"
#include "base/printable.h"
#include "cli/live/commands.h"
#include "record/whole_file.h"

namespace navcal::cli {
namespace {

namespace fs = std::filesystem;

bool is_file_name(const fs::path& path) { return !path.empty() && path != "-"; }

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  const fs::path full_a = fs::weakly_canonical(fs::absolute(a), error);
  const fs::path full_b = fs::weakly_canonical(fs::absolute(b), error);
  return !full_a.empty() && full_a == full_b;
}

/// An output is written under a name of its own first (WholeFile), so that name is written to as well.
bool would_write_to(const fs::path& output, const fs::path& file) {
  if (record::is_written_in_place(output)) return false;
  return is_same_file(output, file) || is_same_file(record::WholeFile::part_of(output), file);
}

}  // namespace

void expect_folder_of(const fs::path& file) {
  if (record::is_written_in_place(file)) return;
  if (std::error_code none; fs::is_directory(file, none))
    throw base::Failure(base::Exit::usage, file.string() + ": this is a folder, not a file");
  const fs::path part = record::WholeFile::part_of(file);  // beside the target of a link
  const fs::path folder = part.has_parent_path() ? part.parent_path() : ".";
  if (::access(folder.c_str(), W_OK) != 0) {
    throw base::Failure(base::Exit::failed, file.string() + ": " + std::system_category().message(errno));
  }
}

void expect_no_overwriting(const Paths& inputs, const Paths& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (!is_file_name(outputs[i])) continue;
    for (const fs::path& input : inputs) {
      if (!is_file_name(input) || !would_write_to(outputs[i], input)) continue;
      throw base::Failure(
          base::Exit::usage,
          fmt::format("{}: this file is both input and output; nothing was done. Give the output another name.",
                      outputs[i].string()));
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (!is_file_name(outputs[k])) continue;
      if (!would_write_to(outputs[i], outputs[k]) && !would_write_to(outputs[k], outputs[i])) continue;
      throw base::Failure(
          base::Exit::usage,
          fmt::format("{}: two outputs have this name; nothing was done. Give each a name of its own.",
                      outputs[i].string()));
    }
  }
}

Paths all_paths(std::initializer_list<std::vector<std::string>> repeatable, Paths others) {
  for (const auto& files : repeatable) others.insert(others.end(), files.begin(), files.end());
  return others;
}

void expect_results(const Paths& inputs, const Paths& outputs) {
  expect_no_overwriting(inputs, outputs);
  for (const fs::path& output : outputs) {
    if (is_file_name(output)) expect_folder_of(output);
  }
}

void expect_not_ending(const fs::path& output, std::string_view ending, std::string_view kind,
                       std::string_view hint) {
  if (output.extension() != ending) return;
  throw base::Failure(base::Exit::usage, fmt::format("{}: the output is {}; {}", output.string(), kind, hint));
}

void write_result(const fs::path& file, std::string_view content) {
  record::WholeFile whole(file);
  whole.write(content);
  whole.commit();
}

void expect_new(const fs::path& file, std::string_view hint) {
  std::error_code error;
  if (file.empty() || !fs::exists(fs::symlink_status(file, error)) || record::is_written_in_place(file)) return;
  throw base::Failure(base::Exit::failed,
                      fmt::format("{}: the file exists and is not overwritten{}", file.string(), hint));
}

void write_new(const fs::path& file, const std::string& text) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0 && errno == EEXIST)
    throw base::Failure(base::Exit::usage, file.string() + ": it is there already, and is not written over");
  if (descriptor < 0) throw std::system_error(errno, std::system_category(), file.string());
  std::FILE* const out = ::fdopen(descriptor, "w");
  const bool written = std::fputs(text.c_str(), out) >= 0;
  if (std::fclose(out) != 0 || !written)
    throw base::Failure(base::Exit::failed, file.string() + ": cannot be written");
}

void print_answer(std::string_view text) {
  base::Output output(STDOUT_FILENO, "standard output");
  output.append(base::printable(text, "\n"));
  output.flush();
}

void give_answer(const std::string& json_file, const std::string& json, std::string_view text) {
  if (is_file_name(json_file)) write_result(json_file, json);
  print_answer(json_file == "-" ? json : text);
}

void tell_remarks(std::string_view command, const std::vector<std::string>& remarks) {
  for (const auto& remark : remarks) fmt::print(stderr, "{}: {}\n", command, base::printable(remark));
}

}  // namespace navcal::cli
