// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <navcal/export.h>

#include <stdexcept>
#include <string>

namespace navcal::api {

/// Kind of an error.
enum class ErrorKind {
  bad_input,     ///< a file is missing, or is not what it should be; what() names file and place
  bad_argument,  ///< an argument cannot be used; what() names it, and the option of the program that sets it
  cancelled,     ///< the progress callback ended the work; nothing was written
  failed,        ///< anything else, such as a full disk
};

/// The only exception of the library besides std::bad_alloc, and besides what a progress callback throws itself.
class NAVCAL_API Error : public std::runtime_error {
 public:
  /// An error of that kind; `message` is for people.
  Error(ErrorKind kind, const std::string& message);
  Error(const Error&) = default;             ///< Copies kind and message.
  Error& operator=(const Error&) = default;  ///< Copies kind and message.
  ~Error() override;

  /// Kind of the error, for programs.
  [[nodiscard]] ErrorKind kind() const noexcept { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace navcal::api
