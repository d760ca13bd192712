// Sends a job to a printer on the network: computed while it is sent, or written to a temporary file first.
#pragma once

#include <functional>

#include "engine/layers/layer_stream.h"
#include "hosts/send_upload.h"
#include "recipe/recipe.h"

namespace lamella {

struct JobSending {
    /// Without a name, the file gets the part's, with a hash of the job, and the ending of its format.
    SendSettings upload;
    /// Which layers, by how many threads; `resume` and `cancel` are those of `upload`.
    StreamOptions stream;
    /// Computes G-code twice instead of writing a file, where the host asks for size or hash first.
    bool no_spool = false;
};

struct JobSendReport {
    std::string name;  ///< of the file at the host
    SendReport upload;
};

/// Throws InputError when the printer's output is a folder, which no host takes, when `no_spool` is asked for
/// what cannot be computed twice, and when nothing is printed; and as send_upload.
JobSendReport send_job(NetworkHost& host, const Recipe& recipe, const Job& job, JobSending sending);

}  // namespace lamella
