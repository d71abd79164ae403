#include "recipe/paper.h"

#include <map>

#include "base/suggest.h"
#include "recipe/document.h"

namespace pelage {

namespace {

/// One command to a line.
std::vector<Given<std::string>> read_commands(const Value& v) {
  std::vector<Given<std::string>> commands;
  Location where = v.text_where();
  std::size_t begin = 0;
  const std::string& text = v.string();
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end > begin) commands.push_back({text.substr(begin, end - begin), where});
    begin = end + 1;
    ++where.line;
  }
  if (commands.empty()) throw Error(Fault::usage, "'run' takes a command at least", v.where());
  return commands;
}

FigurePanel read_panel(const Value& table) {
  FigurePanel panel;
  panel.caption = table.string_or("caption", "");
  panel.commands = read_commands(table.at("run"));
  panel.picture = table.at("picture").string();
  const Value* coat = table.find("coat");
  const Value* field = table.find("field");
  if (!coat != !field)
    throw Error(Fault::usage, "'coat' and 'field' go together: what is measured", (coat ? coat : field)->where());
  if (coat) panel.coat = coat->string();
  if (field) panel.field = field->string();
  return panel;
}

FigureVerdict read_verdict(const Value& v) {
  static const std::map<std::string, FigureVerdict> verdicts = {
      {"made", FigureVerdict::made}, {"otherwise", FigureVerdict::otherwise}, {"misprint", FigureVerdict::misprint}};
  const auto found = verdicts.find(v.string());
  if (found == verdicts.end())
    throw Error(Fault::usage, unknown_name("verdict", v.string(), {"made", "otherwise", "misprint"}), v.where());
  return found->second;
}

PaperFigure read_figure(const Value& table) {
  PaperFigure figure;
  figure.number = table.at("number").string();
  figure.shows = table.at("shows").string();
  figure.verdict = read_verdict(table.at("verdict"));
  figure.said = table.string_or("said", "");
  if (figure.verdict != FigureVerdict::made && figure.said.empty())
    throw Error(Fault::usage, "'said' has to tell what is other than in the paper", table.where());
  if (const Value* panels = table.find("panel"))
    for (const Value& panel : panels->items()) figure.panels.push_back(read_panel(panel));
  return figure;
}

}  // namespace

Paper parse_paper(const std::string& text, const std::string& file, const std::string& name) {
  const Value document = parse_document(text, file);
  Paper paper;
  paper.name = name;
  paper.title = document.at("title").string();
  for (const Value& figure : document.at("figure").items()) paper.figures.push_back(read_figure(figure));
  document.require_all_read();
  return paper;
}

}  // namespace pelage
