// SPDX-License-Identifier: MIT
#include "gltf_resources.h"

#include <algorithm>
#include <cctype>
#include <cstring>

#include "file_io.h"
#include "json_text.h"

namespace sherd {

namespace {

std::string pointer(const char* array, size_t index) {
    return "/" + std::string(array) + "/" + std::to_string(index);
}

/// Splices buffers and images into one document. Buffers without uri other than buffer 0 are
/// placeholders (EXT_meshopt_compression's fallbacks): they hold no bytes and move behind buffer 0.
class ResourceTaker {
  public:
    ResourceTaker(JsonText text, std::vector<uint8_t> bin,
                  const std::optional<std::filesystem::path>& folder, std::string name)
        : text_(std::move(text)), bin_(std::move(bin)), folder_(folder), name_(std::move(name)) {}

    Result<GltfDocument> run(std::string json) {
        if (auto checked = checkOwnBuffer(); !checked)
            return tl::unexpected<Error>(checked.error());
        const bool foreignBuffers = anyUri("buffers");
        const bool foreignImages = anyUri("images");
        if (!foreignBuffers && !foreignImages)
            return GltfDocument{std::move(json), std::move(bin_)};
        if (foreignBuffers) {
            if (auto taken = takeBuffers(); !taken) return tl::unexpected<Error>(taken.error());
        } else {
            placeBufferZero();
        }
        if (foreignImages) {
            if (auto taken = takeImages(); !taken) return tl::unexpected<Error>(taken.error());
        }
        writeBuffers();
        writeViews();
        return GltfDocument{text_.edited(), std::move(bin_)};
    }

  private:
    struct Home {
        size_t buffer = 0;
        size_t offset = 0;
    };

    std::string where(const std::string& place) const { return name_ + place; }

    const JsonNode* list(const char* key) const { return JsonText::find(&text_.root(), key); }

    bool anyUri(const char* key) const {
        const JsonNode* nodes = list(key);
        if (nodes == nullptr || !nodes->isArray()) return false;
        return std::any_of(nodes->members.begin(), nodes->members.end(), [](const JsonMember& m) {
            return JsonText::find(&m.value, "uri") != nullptr;
        });
    }

    Result<size_t> byteLength(size_t index) const {
        const JsonNode* buffer = JsonText::at(list("buffers"), index);
        const auto length = text_.number(JsonText::find(buffer, "byteLength"));
        if (!length || *length == 0)
            return fail(ErrorCode::invalidData, "byteLength must be a whole number above 0",
                        where(pointer("buffers", index) + "/byteLength"));
        return static_cast<size_t>(*length);
    }

    Result<void> checkOwnBuffer() const {
        const JsonNode* buffers = list("buffers");
        if (buffers == nullptr) return {};
        if (!buffers->isArray() || buffers->size() == 0)
            return fail(ErrorCode::invalidData, "buffers must be an array with elements",
                        where("/buffers"));
        const JsonNode* first = JsonText::at(buffers, 0);
        const auto length = byteLength(0);
        if (!length) return tl::unexpected<Error>(length.error());
        if (JsonText::find(first, "uri") == nullptr && *length > bin_.size())
            return fail(ErrorCode::malformed,
                        "buffer 0 names " + std::to_string(*length) +
                            " bytes, the binary chunk has " + std::to_string(bin_.size()),
                        where("/buffers/0/byteLength"));
        return {};
    }

    Result<std::vector<uint8_t>> fetch(const std::string& uri, const std::string& place) const {
        if (uri.rfind("data:", 0) == 0) {
            auto bytes = dataUriBytes(uri);
            if (!bytes) return fail(ErrorCode::malformed, "the data URI is damaged", place);
            return std::move(*bytes);
        }
        const auto path = percentDecoded(uri);
        if (!path || path->empty() || path->find('\0') != std::string::npos)
            return fail(ErrorCode::malformed, "the URI is damaged", place);
        if (uri.find("://") != std::string::npos || std::filesystem::path(*path).is_absolute())
            return fail(ErrorCode::unsupported,
                        "only paths relative to the file are followed, not '" + uri + "'", place);
        if (!folder_)
            return fail(ErrorCode::unsupported,
                        "'" + uri + "' lies outside; load the document from its folder", place);
        auto bytes = readFileWhole(*folder_ / *path);
        if (!bytes)
            return fail(bytes.error().code, bytes.error().message + ": " + bytes.error().where,
                        place);
        return bytes;
    }

    size_t appendAligned(std::span<const uint8_t> bytes) {
        bin_.resize((bin_.size() + 7) / 8 * 8);
        const size_t offset = bin_.size();
        bin_.insert(bin_.end(), bytes.begin(), bytes.end());
        return offset;
    }

    Result<void> takeBuffers() {
        const size_t count = list("buffers")->size();
        size_t placeholders = 0;
        for (size_t i = 0; i < count; ++i) {
            const std::string place = where(pointer("buffers", i));
            const JsonNode* buffer = JsonText::at(list("buffers"), i);
            const JsonNode* uriNode = JsonText::find(buffer, "uri");
            if (uriNode == nullptr) {
                homes_.push_back({i == 0 ? 0 : ++placeholders, 0});
                if (i > 0) kept_.push_back(std::string(text_.raw(*buffer)));
                continue;
            }
            const auto uri = text_.string(uriNode);
            if (!uri) return fail(ErrorCode::malformed, "uri must be a string", place + "/uri");
            const auto length = byteLength(i);
            if (!length) return tl::unexpected<Error>(length.error());
            auto bytes = fetch(*uri, place + "/uri");
            if (!bytes) return tl::unexpected<Error>(bytes.error());
            if (bytes->size() < *length)
                return fail(ErrorCode::malformed,
                            "the buffer is cut short: " + std::to_string(*length) +
                                " bytes are named, there are " + std::to_string(bytes->size()),
                            place);
            bytes->resize(*length);
            homes_.push_back({0, appendAligned(*bytes)});
        }
        return {};
    }

    void placeBufferZero() {
        const JsonNode* buffers = list("buffers");
        for (size_t i = 0; buffers != nullptr && i < buffers->size(); ++i) {
            homes_.push_back({i, 0});
            if (i > 0) kept_.push_back(std::string(text_.raw(*JsonText::at(buffers, i))));
        }
    }

    static std::string mediaType(std::span<const uint8_t> bytes, const std::string& uri) {
        const auto starts = [&](std::initializer_list<uint8_t> magic) {
            return bytes.size() >= magic.size() &&
                   std::equal(magic.begin(), magic.end(), bytes.begin());
        };
        if (starts({0x89, 'P', 'N', 'G'})) return "image/png";
        if (starts({0xFF, 0xD8, 0xFF})) return "image/jpeg";
        if (starts({0xAB, 'K', 'T', 'X', ' ', '2', '0'})) return "image/ktx2";
        if (starts({'R', 'I', 'F', 'F'}) && bytes.size() >= 12 &&
            std::memcmp(bytes.data() + 8, "WEBP", 4) == 0)
            return "image/webp";
        if (uri.rfind("data:", 0) == 0) return uri.substr(5, uri.find_first_of(";,") - 5);
        std::string type = std::filesystem::path(uri).extension().string();
        for (char& c : type) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        if (type == ".jpg" || type == ".jpeg") return "image/jpeg";
        return type.size() > 1 ? "image/" + type.substr(1) : "";
    }

    Result<void> takeImages() {
        const JsonNode* views = list("bufferViews");
        size_t nextView = views != nullptr ? views->size() : 0;
        const JsonNode* images = list("images");
        for (size_t i = 0; i < images->size(); ++i) {
            const JsonNode* image = JsonText::at(images, i);
            const JsonNode* uriNode = JsonText::find(image, "uri");
            if (uriNode == nullptr) continue;
            const std::string place = where(pointer("images", i) + "/uri");
            const auto uri = text_.string(uriNode);
            if (!uri) return fail(ErrorCode::malformed, "uri must be a string", place);
            auto bytes = fetch(*uri, place);
            if (!bytes) return tl::unexpected<Error>(bytes.error());
            const std::string type = mediaType(*bytes, *uri);
            if (bytes->empty() || type.empty())
                return fail(ErrorCode::unsupported, "the image is empty or of no known kind",
                            place);
            newViews_.push_back(
                "{\"buffer\":0,\"byteOffset\":" + std::to_string(appendAligned(*bytes)) +
                ",\"byteLength\":" + std::to_string(bytes->size()) + "}");
            std::string members = "\"bufferView\":" + std::to_string(nextView++);
            if (JsonText::find(image, "mimeType") == nullptr)
                members += ",\"mimeType\":" + jsonQuoted(type);
            text_.replaceMember(*image, "uri", members);
        }
        return {};
    }

    void writeBuffers() {
        const JsonNode* buffers = list("buffers");
        const std::string length = std::to_string(bin_.size());
        if (buffers == nullptr)
            return text_.setMember(text_.root(), "buffers", "[{\"byteLength\":" + length + "}]");
        // Name and extras of the first buffer survive.
        auto first = JsonText::parse(std::string(text_.raw(*JsonText::at(buffers, 0))), name_);
        first->eraseMember(first->root(), "uri");
        first->setMember(first->root(), "byteLength", length);
        kept_.insert(kept_.begin(), first->edited());
        text_.replace(*buffers, jsonArray(kept_));
    }

    /// A bufferView, or the like of it inside EXT_meshopt_compression.
    void moveView(const JsonNode* view) {
        const auto buffer = text_.number(JsonText::find(view, "buffer"));
        if (!buffer || *buffer >= homes_.size()) return;
        const Home home = homes_[*buffer];
        if (home.buffer != *buffer) text_.setMember(*view, "buffer", std::to_string(home.buffer));
        if (home.offset == 0) return;
        const auto offset = text_.number(JsonText::find(view, "byteOffset")).value_or(0);
        text_.setMember(*view, "byteOffset", std::to_string(offset + home.offset));
    }

    void writeViews() {
        const JsonNode* views = list("bufferViews");
        if (views == nullptr) {
            if (!newViews_.empty())
                text_.setMember(text_.root(), "bufferViews", jsonArray(newViews_));
            return;
        }
        for (const JsonMember& view : views->members) {
            moveView(&view.value);
            const JsonNode* extensions = JsonText::find(&view.value, "extensions");
            for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
                moveView(JsonText::find(extensions, name));
        }
        if (!newViews_.empty()) text_.append(*views, newViews_);
    }

    JsonText text_;
    std::vector<uint8_t> bin_;
    std::optional<std::filesystem::path> folder_;
    std::string name_;
    std::vector<Home> homes_;
    std::vector<std::string> kept_;
    std::vector<std::string> newViews_;
};

}  // namespace

Result<GltfDocument> takeInResources(GltfDocument document,
                                     const std::optional<std::filesystem::path>& folder,
                                     const std::string& name) {
    auto text = JsonText::parse(document.json, name);
    if (!text) return tl::unexpected<Error>(text.error());
    return ResourceTaker(std::move(*text), std::move(document.bin), folder, name)
        .run(std::move(document.json));
}

Result<GltfDocument> parseGlb(std::span<const uint8_t> bytes, const std::string& name) {
    auto document = splitGlb(bytes, name);
    if (!document) return document;
    return takeInResources(std::move(*document), std::nullopt, name);
}

Result<GltfDocument> loadGltfDocument(const std::filesystem::path& path) {
    auto bytes = readFileWhole(path);
    if (!bytes) return tl::unexpected<Error>(bytes.error());
    const std::string name = path.string();
    const std::filesystem::path folder = path.parent_path();
    if (bytes->size() >= 4 && std::memcmp(bytes->data(), "glTF", 4) == 0) {
        auto document = splitGlb(*bytes, name);
        if (!document) return document;
        return takeInResources(std::move(*document), folder, name);
    }
    if (bytes->empty()) return fail(ErrorCode::malformed, "the file is empty", name);
    if (path.extension() == ".glb")
        return fail(ErrorCode::malformed, "not a GLB file: it does not start with \"glTF\"", name);
    // Some exporters begin with a byte order mark, which JSON does not allow.
    const bool mark = bytes->size() >= 3 && std::memcmp(bytes->data(), "\xEF\xBB\xBF", 3) == 0;
    GltfDocument document;
    document.json.assign(bytes->begin() + (mark ? 3 : 0), bytes->end());
    return takeInResources(std::move(document), folder, name);
}

}  // namespace sherd
