#include "cli/result_file.h"

#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "cli/commands.h"
#include "record/whole_file.h"

namespace navcal::cli {

void expect_folder_of(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (::access(folder.c_str(), W_OK) != 0) {
    throw Failure(Exit::failed, file.string() + ": " + std::system_category().message(errno));
  }
}

void write_result(const std::filesystem::path& file, std::string_view content) {
  record::WholeFile whole(file);
  whole.write(content);
  whole.commit();
}

}  // namespace navcal::cli
