// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/mosquitto_library.h"

#include <dlfcn.h>

#include <stdexcept>
#include <string>

namespace navcal::web {
namespace {

template <class Function>
void find_function(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(::dlsym(library, name));
  if (function == nullptr) throw std::runtime_error(std::string("--mqtt: libmosquitto has no ") + name);
}

MosquittoLibrary load_mosquitto() {
  void* library = ::dlopen("libmosquitto.so.1", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw std::runtime_error("--mqtt needs libmosquitto1 (apt install libmosquitto1)");
  MosquittoLibrary found;
  find_function(library, "mosquitto_new", found.create);
  find_function(library, "mosquitto_destroy", found.destroy);
  find_function(library, "mosquitto_will_set", found.will_set);
  find_function(library, "mosquitto_username_pw_set", found.login_set);
  find_function(library, "mosquitto_connect_callback_set", found.on_connect);
  find_function(library, "mosquitto_publish_callback_set", found.on_publish);
  find_function(library, "mosquitto_connect_async", found.connect);
  find_function(library, "mosquitto_disconnect", found.disconnect);
  find_function(library, "mosquitto_publish", found.publish);
  find_function(library, "mosquitto_loop_read", found.loop_read);
  find_function(library, "mosquitto_loop_write", found.loop_write);
  find_function(library, "mosquitto_loop_misc", found.loop_misc);
  find_function(library, "mosquitto_socket", found.socket);
  find_function(library, "mosquitto_want_write", found.want_write);
  find_function(library, "mosquitto_strerror", found.text_of_error);
  find_function(library, "mosquitto_connack_string", found.text_of_refusal);
  decltype(&mosquitto_lib_init) begin = nullptr;
  find_function(library, "mosquitto_lib_init", begin);
  begin();
  return found;
}

}  // namespace

const MosquittoLibrary& MosquittoLibrary::instance() {
  static const MosquittoLibrary kLibrary = load_mosquitto();
  return kLibrary;
}

}  // namespace navcal::web
