# SPDX-License-Identifier: Apache-2.0
# Sourced by the other scripts here.

# Lets the kernel run arm64 programs under qemu-user until the script ends. Programs that start programs need this. Fails, with
# the remedy, where it is not so already and the caller is not root.
emulate_arm64() {
  local kernel=/proc/sys/fs/binfmt_misc
  [[ $(dpkg --print-architecture) != arm64 && ! -e $kernel/qemu-aarch64 ]] || return 0
  ((EUID == 0)) || { echo "the kernel does not run arm64 programs: as root, systemctl restart systemd-binfmt, or run this as root" >&2; return 1; }
  emulation_ends="echo -1 >$kernel/qemu-aarch64"
  if [[ ! -e $kernel/register ]]; then
    mount -t binfmt_misc binfmt_misc "$kernel"
    emulation_ends+="; umount $kernel"
  fi
  trap "$emulation_ends" EXIT
  cat /usr/lib/binfmt.d/qemu-aarch64.conf >"$kernel/register"
}
