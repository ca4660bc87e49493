// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/failure.h"
#include "base/interruptible.h"
#include "base/progress.h"
#include "record/log/log_info.h"
#include "record/recording.h"

namespace navcal::cli {

/// Runs a job on a log with progress; turns what it throws into the statuses of the contract.
template <class Job>
auto run_log_job(Job job) {
  const base::Interruptible interruptible;
  base::Progress progress("log");
  return job(record::Progress([&progress](double done) {
    if (base::Interruptible::interrupted())
      throw base::Failure(base::Exit::failed, "interrupted: nothing was written");
    progress.show(done);
  }));
}

/// Checks before the work, not after it, that results can be written. Throws Failure when the folder of a file
/// to be written is missing or not writable.
void expect_folder_of(const std::filesystem::path& file);

using Paths = std::vector<std::filesystem::path>;

/// Throws Failure (usage) when a file to be written is one of the files to be read, or another file to be written:
/// writing it would destroy what the user has. Links are followed. Empty names and "-" are passed over.
void expect_no_overwriting(const Paths& inputs, const Paths& outputs);

/// The files of options that may be repeated, and others.
[[nodiscard]] Paths all_paths(std::initializer_list<std::vector<std::string>> repeatable, Paths others);

/// Both checks; of outputs, empty names and "-" are passed over.
void expect_results(const Paths& inputs, const Paths& outputs);

/// Throws Failure (usage) when the name of an output ends like another kind of file. `kind` says what the file
/// will be, with its usual ending: "a capture (.cap)"; `hint` says how to get the other kind.
void expect_not_ending(const std::filesystem::path& output, std::string_view ending, std::string_view kind,
                       std::string_view hint);

/// Whole or not at all. Throws std::system_error.
void write_result(const std::filesystem::path& file, std::string_view content);

/// Throws Failure when a file, or a link, has this name: people may depend on it. `hint` says what replaces it.
void expect_new(const std::filesystem::path& file, std::string_view hint = {});

/// Writes a new file. Throws Failure when one is there already (usage), which is never written over, or when it
/// cannot be written, or std::system_error.
void write_new(const std::filesystem::path& file, const std::string& text);

/// Text on standard output, printable. Throws Failure when it cannot be written.
void print_answer(std::string_view text);

/// An answer of which --json may name a file, or standard output (-), which then gets JSON in place of the text.
void give_answer(const std::string& json_file, const std::string& json, std::string_view text);

/// Lines on standard error, each with the name of the command before it.
void tell_remarks(std::string_view command, const std::vector<std::string>& remarks);

}  // namespace navcal::cli
