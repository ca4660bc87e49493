// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <matio.h>

#include <memory>
#include <string>
#include <vector>

#include "record/export/part_path.h"

namespace navcal::record {

struct FreeMatVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using MatVariable = std::unique_ptr<matvar_t, FreeMatVariable>;

/// A MAT-file (level 5, compressed) that is being written; throws std::system_error, which names the file. Appears
/// under its name by commit().
class MatFile {
 public:
  explicit MatFile(const std::filesystem::path& path);

  void write(const MatVariable& variable);
  /// matio does not say when the disk took less than it was given: the file is read back before it gets its name.
  void commit();

 private:
  struct Close {
    void operator()(mat_t* file) const { Mat_Close(file); }
  };
  [[noreturn]] void fail() const;

  PartPath path_;
  std::unique_ptr<mat_t, Close> file_;
  std::vector<std::string> written_;
};

}  // namespace navcal::record
