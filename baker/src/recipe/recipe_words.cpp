// SPDX-License-Identifier: MIT
// Words that recipes and the command line share.
#include "sherd/baker/recipe.h"

namespace sherd {

Result<InteriorType> parseInteriorType(std::string_view text) {
    if (text == "medial") return InteriorType::medial;
    if (text == "shell") return InteriorType::shell;
    if (text == "solid") return InteriorType::solid;
    return fail(ErrorCode::badArgument,
                "\"" + std::string(text) + "\" is no way to close pieces: medial, shell or solid");
}

Result<PageWrap> parsePageWrap(std::string_view text) {
    if (text == "texture") return PageWrap::texture;
    if (text == "none") return PageWrap::none;
    if (text == "repeat") return PageWrap::repeat;
    if (text == "mirror") return PageWrap::mirror;
    if (text == "clamp") return PageWrap::clamp;
    return fail(ErrorCode::badArgument, "\"" + std::string(text) +
                                            "\" is no way to wrap a page: texture, none, repeat, "
                                            "mirror or clamp");
}

}  // namespace sherd
