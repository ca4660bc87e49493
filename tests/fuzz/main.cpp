// SPDX-License-Identifier: Apache-2.0
// All fuzz targets in one program: fuzz NAME [options of libFuzzer]; fuzz --list prints the names.
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "tests/fuzz/target.h"

namespace navcal::fuzz {

namespace {

// libFuzzer starts itself anew for some of its options, without arguments that it does not know.
constexpr const char* kVariable = "NAVCAL_FUZZ_TARGET";

std::map<std::string, TargetFunction*>& targets() {
  static std::map<std::string, TargetFunction*> all;
  return all;
}

TargetFunction* chosen = nullptr;

}  // namespace

Target::Target(const char* name, TargetFunction* run) { targets()[name] = run; }

}  // namespace navcal::fuzz

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  using namespace navcal::fuzz;
  const std::string first = *count > 1 ? (*arguments)[1] : "";
  if (first == "--list") {
    for (const auto& [name, run] : targets()) std::puts(name.c_str());
    std::exit(0);
  }
  const char* inherited = std::getenv(kVariable);
  const auto target = targets().find(inherited != nullptr ? inherited : first);
  if (target == targets().end()) {
    std::fprintf(stderr, "usage: fuzz NAME [options of libFuzzer]; fuzz --list prints the names; '%s' is none\n",
                 first.c_str());
    std::exit(2);
  }
  chosen = target->second;
  if (inherited == nullptr) {
    ::setenv(kVariable, first.c_str(), 1);
    (*arguments)[1] = (*arguments)[0];
    ++*arguments;
    --*count;
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return navcal::fuzz::chosen(data, size);
}
