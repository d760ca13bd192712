// Readers of the individual job formats. read_job.h selects among them.
#pragma once

#include <memory>
#include <string>

#include "printers/readers/job_archive.h"
#include "printers/readers/read_job.h"

namespace lamella {

/// All throw InputError with the path and the fault.
std::unique_ptr<JobFile> read_sl1(JobArchive archive);
std::unique_ptr<JobFile> read_nanodlp(JobArchive archive);
std::unique_ptr<JobFile> read_goo(const std::string& path);
std::unique_ptr<JobFile> read_ember(const std::string& path);
std::unique_ptr<JobFile> read_png_stack(const std::string& path);

/// Returns true if the bytes begin like a GOO file; needs the first 12 bytes.
bool begins_as_goo(std::string_view bytes);

}  // namespace lamella
