#include "cli/decode_input.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "cli/commands.h"

namespace navcal::cli {
namespace {

[[noreturn]] void fail(const std::string& name, const char* what) {
  throw Failure(Exit::bad_input, name + ": " + what + ": " + std::system_category().message(errno));
}

}  // namespace

Input::Input(const std::string& file) : name_(file == "-" ? "standard input" : file), block_(kBlock) {
  descriptor_ = file == "-" ? STDIN_FILENO : ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) fail(name_, "cannot open");
  struct stat status {};
  if (::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode)) {
    size_ = static_cast<std::uint64_t>(status.st_size);
  }
}

Input::~Input() {
  if (descriptor_ > STDIN_FILENO) ::close(descriptor_);
}

protocols::Bytes Input::next() {
  while (true) {
    const ssize_t n = ::read(descriptor_, block_.data(), block_.size());
    if (n >= 0) return {block_.data(), static_cast<std::size_t>(n)};
    if (errno != EINTR) fail(name_, "cannot read");
  }
}

}  // namespace navcal::cli
