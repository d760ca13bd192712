// The reader of each format. read_job.h chooses among them.
#pragma once

#include <memory>
#include <string>

#include "printers/readers/job_archive.h"
#include "printers/readers/read_job.h"

namespace lamella {

/// All throw InputError with the path and what is wrong.
std::unique_ptr<JobFile> read_sl1(JobArchive archive);
std::unique_ptr<JobFile> read_nanodlp(JobArchive archive);
std::unique_ptr<JobFile> read_goo(const std::string& path);
std::unique_ptr<JobFile> read_ember(const std::string& path);
std::unique_ptr<JobFile> read_png_stack(const std::string& path);

/// Whether bytes begin as a GOO file does; 12 of them decide.
bool begins_as_goo(std::string_view bytes);

}  // namespace lamella
