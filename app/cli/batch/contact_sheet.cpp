// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/batch/contact_sheet.h"

#include <QBuffer>
#include <QImage>
#include <QString>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <optional>

#include "app/cli/batch/drawn_lines.h"
#include "app/cli/batch/page_record.h"
#include "core/base/content_hash.h"
#include "core/base/number_text.h"
#include "core/base/parallel.h"
#include "core/base/platform.h"
#include "core/base/regular_file.h"
#include "core/base/shown_text.h"
#include "core/exchange/save_atomically.h"
#include "core/image/file/scan_reader.h"
#include "core/image/rectify/resample.h"
#include "core/image/rectify/sheet_map.h"

namespace batten::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kPictureSide = 320;         // [px] of the longer side
constexpr int kPictureQuality = 75;       // of JPEG, 0..100
constexpr double kLineUnits = 1000.0;     // width of the drawing that holds the lines
constexpr std::size_t kPagesAFile = 500;  // a browser shows so many curves at once without a wait

// of the page
constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>Batten: contact sheet</title><style>
body{font:14px/1.4 Inter,system-ui,sans-serif;margin:16px;background:#f4f5f7;color:#1c1f23}
main{display:grid;grid-template-columns:repeat(auto-fill,minmax(240px,1fr));gap:12px;margin-top:10px}
figure{margin:0;padding:8px;background:#fff;border-radius:6px;border-top:4px solid #2c9a4b}
figure.empty{border-color:#c98a00}figure.failed{border-color:#c62b2b}figure.waiting{border-color:#9aa1a9}
nav a,nav b{margin-right:8px}
.picture{display:block;position:relative;background:#e8eaed}
.picture img{display:block;width:100%;height:100%;opacity:.75}
.picture svg{position:absolute;left:0;top:0;width:100%;height:100%;overflow:hidden}
path{fill:none;stroke:#c8102e;stroke-width:1.6;vector-effect:non-scaling-stroke}
#curves:not(:checked)~main svg{display:none}
figcaption{margin-top:6px;overflow-wrap:anywhere}small{color:#5c636b;display:block}
</style></head><body>
)";

QByteArray escaped(const std::string& text) { return QString::fromStdString(shownText(text)).toHtmlEscaped().toUtf8(); }

/// The address of a file as seen from the sheet's folder. Names are bytes.
QByteArray linkTo(const std::string& file, const fs::path& folder) {
  std::error_code code;
  const fs::path whole = fs::absolute(file, code).lexically_normal();
  const fs::path relative = whole.lexically_relative(folder);
  return QByteArray::fromStdString((relative.empty() ? whole : relative).generic_string()).toPercentEncoding("/");
}

/// How the page was rectified before it was traced, by what the trace has printed.
std::optional<Rectification> rectificationIn(const std::optional<PageRecord>& record) {
  if (!record || !record->figures.is_object() || !record->figures.contains("rectified")) return std::nullopt;
  const auto& said = record->figures["rectified"];
  RectifyParams params;
  Rectification made;
  try {
    for (std::size_t i = 0; i < params.cornersPx.size(); ++i)
      params.cornersPx[i] =
          Vec2(said.at("corners").at(i).at(0).get<double>(), said.at("corners").at(i).at(1).get<double>());
    made.widthPx = said.at("width").get<int>();
    made.heightPx = said.at("height").get<int>();
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;  // not written by us
  }
  params.use = RectifyUse::Corners;
  made.cornersPx = params.cornersPx;
  if (validate(params)) return std::nullopt;
  return made;
}

/// Whether a page of this size can have been made of a picture: the record is a file that anyone may have changed.
bool isPageOf(const GreyImage& picture, const Rectification& page) {
  constexpr double kMostPagePixels = 4.0;  // for one of the picture; rectifying makes fewer, with corners outside, too
  const auto pixels = [](double width, double height) { return width * height; };
  return page.widthPx > 0 && page.heightPx > 0 &&
         pixels(page.widthPx, page.heightPx) <= kMostPagePixels * pixels(picture.width, picture.height);
}

/// The page made small by averaging; the empty image if its scan cannot be read.
QImage smallPicture(const BatchPage& page, const std::optional<Rectification>& rectification) {
  RunContext context;
  context.threads = 1;
  auto scan = readScan(page.scan, {.page = {page.page, PageChoice{}.pdfDpi}}, context);
  if (!scan) return {};
  if (rectification && isPageOf(scan->grey, *rectification))
    scan->grey =
        resampled(scan->grey, SheetMap(*rectification), rectification->widthPx, rectification->heightPx, context);
  const GreyImage& grey = scan->grey;
  const int step =
      std::max(1, static_cast<int>(std::ceil(static_cast<double>(std::max(grey.width, grey.height)) / kPictureSide)));
  QImage picture((grey.width + step - 1) / step, (grey.height + step - 1) / step, QImage::Format_Grayscale8);
  for (int y = 0; y < picture.height(); ++y) {
    uchar* row = picture.scanLine(y);
    for (int x = 0; x < picture.width(); ++x) {
      double sum = 0.0;
      int count = 0;
      for (int v = y * step; v < std::min(grey.height, (y + 1) * step); ++v) {
        for (int u = x * step; u < std::min(grey.width, (x + 1) * step); ++u, ++count) sum += grey.level(u, v);
      }
      row[x] = static_cast<uchar>(std::lround(sum / count));
    }
  }
  return picture;
}

/// What a sheet shows of one page.
struct Card {
  std::string kind = "failed";  ///< "done", "empty", "failed" or "waiting".
  std::string picture;          ///< File of the small picture; empty: there is none.
  double aspect = 1.0;          ///< Width over height.
  QByteArray figures;
};

QByteArray figuresOf(const PageRecord& record) {
  const auto number = [&](const char* key) {
    const bool isThere = record.figures.is_object() && record.figures.contains(key) && record.figures[key].is_number();
    return isThere ? record.figures[key].get<double>() : 0.0;
  };
  QByteArray text = QByteArray::fromStdString(counted(static_cast<int>(number("curves")), "curve", "curves")) + " in " +
                    QByteArray::fromStdString(counted(static_cast<int>(number("pieces")), "piece", "pieces")) + "; " +
                    QByteArray::number(record.seconds, 'f', 1) + " s";
  if (const double bytes = number("peak_memory_bytes"); bytes > 0.0)
    text += ", " + QByteArray::number(1e-6 * bytes, 'f', 0) + " MB";
  if (record.figures.is_object() && record.figures.contains("notes") && record.figures["notes"].is_array()) {
    for (const auto& note : record.figures["notes"]) {
      if (note.is_string()) text += "<br>" + escaped(note.get<std::string>());
    }
  }
  return text;
}

QImage pictureIn(const std::string& file) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{64} << 20;  // limit of input
  const auto bytes = readWhole(file, kMostBytes);
  return bytes ? QImage::fromData(QByteArray::fromStdString(*bytes)) : QImage();
}

/// @return CannotWrite if the small picture cannot be written.
Result<Card> cardOf(const BatchPage& page, const std::string* error, const fs::path& pictures) {
  Card card;
  const auto hash = fileHash(page.scan);
  const auto record = readRecord(page);
  const auto key = pageKey(page, hash);
  if (error != nullptr) {
    card.figures = escaped(*error);
  } else if (record && key && isUnchanged(page, *record, *key)) {
    card.kind = record->isEmpty ? "empty" : "done";
    card.figures = record->isEmpty ? escaped(record->note) : figuresOf(*record);
  } else {
    card.kind = "waiting";
    card.figures = "pending";
  }
  if (!hash) return card;
  const std::string number = page.page == 1 ? std::string() : "-p" + std::to_string(page.page);
  const auto rectification = card.kind == "done" ? rectificationIn(record) : std::nullopt;
  // The same scan may be rectified otherwise the next time.
  const std::string shape =
      rectification ? "-" + HashBuilder().text(record->figures["rectified"].dump()).finish().hex().substr(0, 8)
                    : std::string();
  card.picture = (pictures / (hash->substr(0, 24) + number + shape + ".jpg")).string();
  QImage picture = pictureIn(card.picture);
  if (picture.isNull()) {
    picture = smallPicture(page, rectification);
    if (picture.isNull()) {
      card.picture.clear();
      return card;
    }
    QBuffer bytes;
    if (!bytes.open(QIODevice::WriteOnly) || !picture.save(&bytes, "JPG", kPictureQuality)) {
      return fail(ErrorCode::CannotWrite, "Cannot write the thumbnails of the overview: this Qt has no JPEG writer.");
    }
    const QByteArray& made = bytes.data();
    if (auto saved = saveAtomically(card.picture, std::string_view(made.data(), made.size())); !saved) {
      return fail(saved.error());
    }
  }
  card.aspect = static_cast<double>(picture.width()) / picture.height();
  return card;
}

QByteArray overlayOf(const BatchPage& page) {
  for (const std::string& output : page.outputs) {
    const DrawnLines drawn = drawnLines(output);
    if (drawn.lines.empty()) continue;
    const double height = kLineUnits / drawn.aspect;
    QByteArray svg =
        "<svg viewBox=\"0 0 1000 " + QByteArray::number(height, 'f', 1) + "\" preserveAspectRatio=\"none\">";
    for (const auto& line : drawn.lines) {
      svg += "<path d=\"M";
      for (const Vec2& p : line) {
        svg += QByteArray::number(kLineUnits * p.x(), 'f', 1) + " " + QByteArray::number(height * p.y(), 'f', 1) + " ";
      }
      svg += "\"/>";
    }
    return svg + "</svg>";
  }
  return {};
}

/// What is shown of one page. `name` says which it is.
QByteArray figureOf(const BatchPage& page, const Card& card, const std::string& name, const fs::path& folder) {
  QByteArray html = "<figure class=\"" + QByteArray::fromStdString(card.kind) + "\">";
  const QByteArray overlay = card.kind == "done" ? overlayOf(page) : QByteArray();
  if (!card.picture.empty()) {
    html += "<a class=\"picture\" style=\"aspect-ratio:" + QByteArray::number(card.aspect, 'f', 4) + "\" href=\"" +
            linkTo(card.kind == "done" ? page.outputs.front() : page.scan, folder) + "\"><img loading=\"lazy\" alt=\"" +
            escaped(name) + "\" src=\"" + linkTo(card.picture, folder) + "\">" + overlay + "</a>";
  }
  html += "<figcaption><b>" + escaped(name) + "</b> ";
  if (card.kind == "done") {
    for (const std::string& output : page.outputs) {
      const std::string ending = fs::path(output).extension().string();
      html +=
          "<a href=\"" + linkTo(output, folder) + "\">" + escaped(ending.empty() ? output : ending.substr(1)) + "</a> ";
    }
  }
  html += "<small>" + card.figures;
  if (card.kind == "done" && overlay.isEmpty())
    html += "<br>The picture shows only the scan; curves are shown for SVG or JSON outputs.";
  return html + "</small></figcaption></figure>\n";
}

/// The files of a sheet, the first of which is the one that was asked for.
std::vector<fs::path> filesOfSheet(std::size_t pages, const fs::path& whole) {
  std::vector<fs::path> files{whole};
  const fs::path folder = whole.parent_path() / (whole.stem().string() + "_files");
  for (std::size_t begin = kPagesAFile; begin < pages; begin += kPagesAFile)
    files.push_back(folder / ("sheet-" + std::to_string(files.size() + 1) + ".html"));
  return files;
}

/// Links from one file of a sheet to the others: which pages each shows.
QByteArray linksOf(const std::vector<fs::path>& files, std::size_t present, std::size_t pages) {
  if (files.size() == 1) return {};
  QByteArray html = "<nav>Pages ";
  for (std::size_t i = 0; i < files.size(); ++i) {
    const QByteArray range = QByteArray::number(static_cast<qlonglong>(i * kPagesAFile + 1)) + "–" +
                             QByteArray::number(static_cast<qlonglong>(std::min(pages, (i + 1) * kPagesAFile)));
    if (i == present) {
      html += "<b>" + range + "</b> ";
    } else {
      html += "<a href=\"" + linkTo(files[i].string(), files[present].parent_path()) + "\">" + range + "</a> ";
    }
  }
  return html + "</nav>\n";
}

/// "wing.tif", or "wing.tif, page 2" where the file holds several.
std::vector<std::string> captionsOf(const std::vector<BatchPage>& pages) {
  std::map<std::string, int> times;
  for (const BatchPage& page : pages) ++times[page.scan];
  std::vector<std::string> captions;
  for (const BatchPage& page : pages) {
    captions.push_back(fs::path(page.scan).filename().string());
    if (page.page != 1 || times[page.scan] > 1) captions.back() += ", page " + std::to_string(page.page);
  }
  return captions;
}

}  // namespace

std::vector<std::string> sheetFiles(std::size_t pages, const std::string& file) {
  std::vector<std::string> names;
  for (const fs::path& one : filesOfSheet(pages, file)) names.push_back(one.string());
  names.erase(names.begin());
  return names;
}

Result<void> writeContactSheet(const std::vector<BatchPage>& pages, const std::map<std::size_t, std::string>& errors,
                               const std::string& file) {
  std::error_code code;
  const fs::path whole = fs::absolute(file, code).lexically_normal(), folder = whole.parent_path();
  const fs::path pictures = folder / (whole.stem().string() + "_files");
  fs::create_directories(pictures, code);
  if (code)
    return fail(ErrorCode::CannotWrite, "Cannot make the folder " + shownName(pictures) + ": " + code.message() + ".");
  std::vector<Result<Card>> cards(pages.size(), Card{});
  {
    const QuietStderr quiet;
    parallelFor(RunContext{}, static_cast<int>(pages.size()), 1, [&](int begin, int) {
      const auto error = errors.find(begin);
      cards[begin] = cardOf(pages[begin], error == errors.end() ? nullptr : &error->second, pictures);
    });
  }
  std::map<std::string, int> kinds;
  for (const Result<Card>& card : cards) {
    if (!card) return fail(card.error());
    ++kinds[card->kind];
  }
  const QByteArray summary = "<h1>" + QByteArray::number(static_cast<qlonglong>(pages.size())) +
                             (pages.size() == 1 ? " page" : " pages") + "</h1><p>" + QByteArray::number(kinds["done"]) +
                             " done, " + QByteArray::number(kinds["empty"]) + " without a curve, " +
                             QByteArray::number(kinds["failed"]) + " failed, " + QByteArray::number(kinds["waiting"]) +
                             " not reached</p>\n";
  const std::vector<std::string> captions = captionsOf(pages);
  const std::vector<fs::path> files = filesOfSheet(pages.size(), whole);
  for (std::size_t k = files.size(); k-- > 0;) {  // the first file last: its links lead somewhere
    const QByteArray links = linksOf(files, k, pages.size());
    QByteArray html = kHead + summary + links + "<input type=\"checkbox\" id=\"curves\" checked>" +
                      "<label for=\"curves\">Curves</label>\n<main>\n";
    const std::size_t end = std::min(pages.size(), (k + 1) * kPagesAFile);
    for (std::size_t i = k * kPagesAFile; i < end; ++i)
      html += figureOf(pages[i], *cards[i], captions[i], files[k].parent_path());
    html += "</main>" + links + "</body></html>\n";
    if (auto saved = saveAtomically(files[k], std::string_view(html.data(), html.size())); !saved) return saved;
  }
  return {};
}

}  // namespace batten::cli
