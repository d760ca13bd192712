// Identity: a 128-bit hash of everything that decides a job's bytes. Two jobs with equal identity make equal
// output.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "recipe/recipe.h"

namespace lamella {

class InputCache;

/// FNV-1a with 128 bits (Fowler, Noll, Vo: offset basis and prime as published). It detects accidental
/// changes; it does not protect against forgery.
class Fnv128 {
  public:
    void add(std::string_view bytes);
    /// 32 hexadecimal digits.
    std::string hex() const;

  private:
    std::uint64_t high_ = 0x6c62272e07bb0142U;
    std::uint64_t low_ = 0x62b821756295c58dU;
};

/// Returns the hash of a file's bytes. Throws InputError when it cannot be read.
std::string hash_file(const std::string& path);

/// Returns the hash of an input: a file, a folder or pattern of pages, a header with its data. `cache`: what
/// is known of files; may be null.
std::string hash_input(const std::string& path, InputCache* cache = nullptr);

/// Returns the job's identity: the hash of the program version and every setting's value (an input counts by
/// its bytes, not by its path). `cache` as in hash_input().
std::string job_identity(const Recipe& recipe, InputCache* cache = nullptr);

}  // namespace lamella
