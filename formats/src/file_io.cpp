// SPDX-License-Identifier: MIT
#include "file_io.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "sherd/formats/glb_write.h"

namespace sherd {

namespace {

std::string reason(int code) {
    return std::generic_category().message(code);
}

/// Closes on every way out.
class Descriptor {
  public:
    explicit Descriptor(int fd) : fd_(fd) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { close(); }
    int get() const { return fd_; }
    int close() {
        const int result = fd_ >= 0 ? ::close(fd_) : 0;
        fd_ = -1;
        return result;
    }

  private:
    int fd_;
};

int writeAll(int fd, std::span<const uint8_t> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(fd, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return written == 0 ? ENOSPC : errno;
        bytes = bytes.subspan(static_cast<size_t>(written));
    }
    return ::fsync(fd) != 0 && errno != EINVAL ? errno : 0;
}

tl::unexpected<Error> cannotWrite(const std::filesystem::path& path, int code) {
    const char* advice = code == ENOENT   ? "; does the directory exist?"
                         : code == ENOSPC ? "; the disk is full"
                         : code == EACCES ? "; may you write in this directory?"
                         : code == EISDIR ? "; name a file, not a directory"
                                          : "";
    return fail(ErrorCode::fileWrite, "cannot write the file: " + reason(code) + advice,
                path.string());
}

/// Device files such as /dev/null cannot be renamed over.
bool isSpecialFile(const std::filesystem::path& path) {
    struct stat info {};
    return ::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
}

mode_t newFileMode(const std::filesystem::path& path) {
    struct stat info {};
    if (::stat(path.c_str(), &info) == 0) return info.st_mode & 0777;
    return 0666;
}

Result<void> writeSpecial(const std::filesystem::path& path, std::span<const uint8_t> bytes) {
    const Descriptor out(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (out.get() < 0) return cannotWrite(path, errno);
    if (const int code = writeAll(out.get(), bytes)) return cannotWrite(path, code);
    return {};
}

}  // namespace

Result<std::vector<uint8_t>> readFileWhole(const std::filesystem::path& path) {
    const Descriptor in(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (in.get() < 0) {
        const bool missing = errno == ENOENT || errno == ENOTDIR;
        return fail(missing ? ErrorCode::fileNotFound : ErrorCode::fileRead,
                    missing ? "the file does not exist" : "cannot open the file: " + reason(errno),
                    path.string());
    }
    struct stat info {};
    if (::fstat(in.get(), &info) != 0 || S_ISDIR(info.st_mode))
        return fail(ErrorCode::fileRead, "this is a directory, not a file", path.string());
    std::vector<uint8_t> bytes(static_cast<size_t>(std::max<off_t>(info.st_size, 0)) + 1);
    size_t size = 0;
    while (true) {
        const ssize_t got = ::read(in.get(), bytes.data() + size, bytes.size() - size);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0)
            return fail(ErrorCode::fileRead, "cannot read the file: " + reason(errno),
                        path.string());
        if (got == 0) break;
        size += static_cast<size_t>(got);
        if (size == bytes.size()) bytes.resize(2 * bytes.size());
    }
    bytes.resize(size);
    return bytes;
}

Result<void> writeFileWhole(const std::filesystem::path& path, std::span<const uint8_t> bytes) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) return cannotWrite(path, EISDIR);
    if (isSpecialFile(path)) return writeSpecial(path, bytes);
    // Through a symbolic link the link's target is replaced, as writing in place would.
    std::filesystem::path target = path;
    if (std::filesystem::is_symlink(path, ignored)) {
        const std::filesystem::path real = std::filesystem::weakly_canonical(path, ignored);
        if (!real.empty()) target = real;
    }
    // The process id keeps two bakes to the same target apart.
    const std::filesystem::path temporary =
        target.string() + ".part" + std::to_string(static_cast<long>(::getpid()));
    int code = 0;
    {
        Descriptor out(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC,
                              newFileMode(target)));
        if (out.get() < 0) return cannotWrite(path, errno);
        code = writeAll(out.get(), bytes);
        if (out.close() != 0 && code == 0) code = errno;
    }
    if (code == 0 && std::rename(temporary.c_str(), target.c_str()) != 0) code = errno;
    if (code != 0) {
        ::unlink(temporary.c_str());
        return cannotWrite(path, code);
    }
    return {};
}

}  // namespace sherd
