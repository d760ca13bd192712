// RecipeMistakes: what is wrong with a recipe that was sent, by lines.
#pragma once

#include <string>

#include "app/http/http_server.h"

namespace lamella {

/// Answers with status 422 and `mistakes`: [{"line": 7, "text": "foam.cell: ..."}]; a line may be null.
class RecipeMistakes : public HttpError {
  public:
    /// `message`: of the library, a line for each mistake; `path` is the name that it gives the recipe.
    RecipeMistakes(const std::string& message, const std::string& path);
};

}  // namespace lamella
