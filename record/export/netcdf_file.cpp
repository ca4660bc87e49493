// SPDX-License-Identifier: Apache-2.0
#include "record/export/netcdf_file.h"

#include <netcdf.h>
#include <netcdf_mem.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

namespace navcal::record {
namespace {

/// Values that are compressed together.
constexpr std::size_t kChunk = 65536;
/// More makes files hardly smaller and takes several times as long.
constexpr int kDeflateLevel = 2;
constexpr std::size_t kFirstBytes = 1 << 12;
constexpr const char* kFillValue = "_FillValue";

}  // namespace

NetcdfFile::NetcdfFile(const std::filesystem::path& path) : disk_(path) {
  check(nc_create_mem(path.c_str(), NC_NETCDF4 | NC_CLOBBER, kFirstBytes, &file_));
  open_ = true;
  // Everything is written once: filling it first would write it twice.
  int before = 0;
  check(nc_set_fill(file_, NC_NOFILL, &before));
}

NetcdfFile::~NetcdfFile() {
  if (open_) nc_abort(file_);
}

void NetcdfFile::check(int status) const {
  if (status == NC_NOERR) return;
  // Positive: errno. Others are the library's own, and their words its only account.
  if (status > 0) throw std::system_error(status, std::system_category(), disk_.path().string());
  throw std::system_error(std::make_error_code(std::errc::io_error),
                          disk_.path().string() + ": " + nc_strerror(status));
}

NetcdfFile::Group NetcdfFile::add_group(const std::string& name) {
  Group group = 0;
  check(nc_def_grp(file_, name.c_str(), &group));
  return group;
}

int NetcdfFile::add_dimension(Group group, const std::string& name, std::size_t length) {
  int dimension = 0;
  check(nc_def_dim(group, name.c_str(), length, &dimension));
  return dimension;
}

NetcdfFile::Variable NetcdfFile::add_variable(Group group, const std::string& name, int type, int dimension,
                                              std::size_t length) {
  Variable variable{group, 0};
  check(nc_def_var(group, name.c_str(), type, 1, &dimension, &variable.id));
  const std::size_t chunk = std::clamp<std::size_t>(length, 1, kChunk);
  check(nc_def_var_chunking(group, variable.id, NC_CHUNKED, &chunk));
  if (type != NC_STRING) check(nc_def_var_deflate(group, variable.id, 1, 1, kDeflateLevel));
  return variable;
}

void NetcdfFile::attribute(Group group, const std::string& name, std::string_view text) {
  check(nc_put_att_text(group, NC_GLOBAL, name.c_str(), text.size(), text.data()));
}

void NetcdfFile::attribute(Variable variable, const std::string& name, std::string_view text) {
  check(nc_put_att_text(variable.group, variable.id, name.c_str(), text.size(), text.data()));
}

void NetcdfFile::attribute(Variable variable, const std::string& name, std::span<const std::int8_t> values) {
  check(nc_put_att_schar(variable.group, variable.id, name.c_str(), NC_BYTE, values.size(), values.data()));
}

void NetcdfFile::fill_value(Variable variable, double value) {
  check(nc_put_att_double(variable.group, variable.id, kFillValue, NC_DOUBLE, 1, &value));
}

void NetcdfFile::fill_value(Variable variable, std::int64_t value) {
  const long long wide = value;
  check(nc_put_att_longlong(variable.group, variable.id, kFillValue, NC_INT64, 1, &wide));
}

void NetcdfFile::fill_value(Variable variable, std::int8_t value) {
  check(nc_put_att_schar(variable.group, variable.id, kFillValue, NC_BYTE, 1, &value));
}

void NetcdfFile::write(Variable variable, std::span<const double> values) {
  check(nc_put_var(variable.group, variable.id, values.data()));
}

void NetcdfFile::write(Variable variable, std::span<const std::int64_t> values) {
  check(nc_put_var(variable.group, variable.id, values.data()));
}

void NetcdfFile::write(Variable variable, std::span<const std::int8_t> values) {
  check(nc_put_var(variable.group, variable.id, values.data()));
}

void NetcdfFile::write(Variable variable, std::vector<const char*>& texts) {
  check(nc_put_var_string(variable.group, variable.id, texts.data()));
}

void NetcdfFile::commit() {
  open_ = false;
  NC_memio whole{};
  check(nc_close_memio(file_, &whole));
  const std::unique_ptr<void, decltype(&std::free)> bytes(whole.memory, &std::free);
  disk_.write({static_cast<const char*>(bytes.get()), whole.size});
  disk_.commit();
}

}  // namespace navcal::record
