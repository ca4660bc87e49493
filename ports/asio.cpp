// SPDX-License-Identifier: Apache-2.0
// All of Asio that is not a template, compiled here and nowhere else.
#include <boost/asio/impl/src.hpp>
