#include "figures_page.h"

#include "html_page.h"
#include "io/xml_text.h"

namespace pelage {

namespace {

constexpr int picture_width = 420;

std::string commands_of(const FigurePanel& panel) {
  std::string text;
  for (const Given<std::string>& command : panel.commands)
    text += (text.empty() ? "pelage " : "\npelage ") + command.value;
  return "<code class=\"command\">" + escape_xml(text) + "</code>";
}

std::string panel_text(const FigurePanel& panel, const MadePanel& made) {
  const std::string above = made.failure.empty() ? page_picture(panel.picture, panel.caption, picture_width)
                                                 : page_paragraph(made.failure, "failure");
  const std::string numbers = made.numbers.empty() ? "" : ": " + made.numbers;
  return "<figure>" + above + "<figcaption>" + escape_xml(panel.caption + numbers) + commands_of(panel) +
         "</figcaption></figure>\n";
}

std::string figure_text(const Paper& paper, const PaperFigure& figure, const std::vector<MadePanel>& made) {
  const std::string said = verdict_in_words(figure.verdict) + (figure.said.empty() ? "" : ": " + figure.said);
  std::string text = "<section id=\"" + page_anchor(figure_id(paper, figure)) + "\">\n<h2>Figure " +
                     escape_xml(figure.number) + " <code>" + escape_xml(figure_id(paper, figure)) + "</code></h2>\n" +
                     page_paragraph(figure.shows) + page_paragraph(said, "cite") + "<div class=\"pictures\">\n";
  for (std::size_t k = 0; k < figure.panels.size(); ++k) text += panel_text(figure.panels[k], made[k]);
  return text + "</div>\n</section>\n";
}

}  // namespace

std::string figure_id(const Paper& paper, const PaperFigure& figure) { return paper.name + "-" + figure.number; }

std::string verdict_in_words(FigureVerdict verdict) {
  switch (verdict) {
    case FigureVerdict::made:
      return "made";
    case FigureVerdict::otherwise:
      return "made otherwise";
    case FigureVerdict::misprint:
      break;
  }
  return "misprint";
}

std::string figures_page(const std::vector<FiguresOfPaper>& papers) {
  std::string text = page_head("The papers, figure by figure") + "<nav>\n";
  for (const FiguresOfPaper& of : papers)
    for (const PaperFigure* figure : of.figures)
      text += "<a href=\"#" + page_anchor(figure_id(*of.paper, *figure)) + "\">" +
              escape_xml(figure_id(*of.paper, *figure)) + "</a>\n";
  text += "</nav>\n";
  for (const FiguresOfPaper& of : papers) {
    text += "<h1>" + escape_xml(of.paper->title) + "</h1>\n";
    for (std::size_t k = 0; k < of.figures.size(); ++k) text += figure_text(*of.paper, *of.figures[k], of.made[k]);
  }
  return text + page_end;
}

}  // namespace pelage
