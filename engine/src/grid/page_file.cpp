// SPDX-License-Identifier: Apache-2.0
#include "grid/page_file.hpp"

#include <cerrno>
#include <system_error>

#ifdef __linux__
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace evigrid {

void PageFile::fail(const char* what, int error) const {
  throw std::system_error(error, std::generic_category(), "page file in " + directory_ + ": " + what);
}

std::uint64_t PageFile::take_extent() {
  if (!free_.empty()) {
    const std::uint64_t at = free_.back();
    free_.pop_back();
    return at;
  }
  free_.reserve(static_cast<std::size_t>(end_ / kExtent) + 1);  // so that giving back never allocates
  const std::uint64_t at = end_;
  end_ += kExtent;
  return at;
}

#ifdef __linux__

PageFile::PageFile(const std::filesystem::path& directory) : directory_(directory.string()) {
  file_ = open(directory_.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file_ < 0 && (errno == EOPNOTSUPP || errno == EISDIR || errno == ENOENT)) {  // no such files in this file system
    std::string name = directory_ + "/evigrid-pages-XXXXXX";
    file_ = mkostemp(name.data(), O_CLOEXEC);
    if (file_ >= 0) unlink(name.c_str());
  }
  if (file_ < 0) fail("cannot be made", errno);
  maker_ = getpid();
}

PageFile::~PageFile() {
  if (file_ >= 0) close(file_);
}

bool PageFile::ours() const noexcept { return maker_ == getpid(); }

/// A wish: refused, the file stays as large as it is.
void PageFile::punch(std::uint64_t offset, std::size_t bytes) noexcept {
  if (!ours()) return;
  fallocate(file_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, static_cast<off_t>(offset), static_cast<off_t>(bytes));
}

bool PageFile::possible(std::size_t bytes) noexcept {
  const long page = sysconf(_SC_PAGESIZE);
  return page > 0 && bytes % static_cast<std::size_t>(page) == 0;
}

void PageFile::give_back_extent(std::uint64_t at) noexcept {
  punch(at, kExtent);
  free_.push_back(at);
}

void PageFile::page_out(void* at, std::size_t bytes, std::uint64_t offset) {
  if (!ours()) fail("belongs to the process that this one was forked from", EPERM);
  const char* from = static_cast<const char*>(at);
  for (std::size_t done = 0; done < bytes;) {
    const ssize_t n = pwrite(file_, from + done, bytes - done, static_cast<off_t>(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail("cannot be written", n < 0 ? errno : ENOSPC);
    done += static_cast<std::size_t>(n);
  }
  if (mmap(at, bytes, PROT_READ, MAP_SHARED | MAP_FIXED, file_, static_cast<off_t>(offset)) == MAP_FAILED)
    fail("cannot be mapped", errno);
}

bool PageFile::take_back(void* at, std::size_t bytes, std::uint64_t offset) noexcept {
  if (mmap(at, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) == MAP_FAILED)
    return false;
  madvise(at, bytes, MADV_HUGEPAGE);  // as its neighbours, so that the mappings join
  punch(offset, bytes);
  return true;
}

#else

PageFile::PageFile(const std::filesystem::path& directory) : directory_(directory.string()) {
  fail("this system maps no file over memory as paging needs it", ENOTSUP);
}
PageFile::~PageFile() = default;
bool PageFile::ours() const noexcept { return false; }
void PageFile::punch(std::uint64_t, std::size_t) noexcept {}
bool PageFile::possible(std::size_t) noexcept { return false; }
void PageFile::give_back_extent(std::uint64_t) noexcept {}
void PageFile::page_out(void*, std::size_t, std::uint64_t) { fail("cannot be written", ENOTSUP); }
bool PageFile::take_back(void*, std::size_t, std::uint64_t) noexcept { return false; }

#endif

}  // namespace evigrid
