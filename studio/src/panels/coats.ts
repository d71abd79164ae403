/** Coats and models as picture cards, with a search. */

import { choice, el, icon } from "../dom";
import { quoted, stringValue, stageValue, topValue } from "../recipe-text";
import type { Studio } from "../studio";

interface Card {
  id: string;
  title: string;
  summary: string;
  picture: string;
  choose: () => void;
  node?: HTMLButtonElement;
}

/** A recipe that grows one model as its file has it. */
export function recipeOfModel(model: string): string {
  return `name = ${quoted(model)}\n\n[stage]\nmodel = ${quoted(model)}\nsize = 0.05\n`;
}

const pictureOf = (kind: string, name: string): string => `./gallery/${kind}/${name.replace(/[^a-z0-9-]/gi, "-")}-animal.png`;

function recipeCards(studio: Studio): Card[] {
  return (studio.catalog?.recipes ?? []).map(({ name, summary }) => ({
    id: name,
    title: name,
    summary,
    picture: pictureOf("recipes", name),
    choose: () => {
      const asked = studio.recipeText(name);
      asked.then((text) => studio.edit(text, { label: `coat ${name}`, change: "restart" })).catch((error: unknown) => studio.fail(error, name));
    },
  }));
}

function modelCards(studio: Studio): Card[] {
  const card = (id: string, summary: string): Card => ({
    id,
    title: id.replace(":", " · "),
    summary,
    picture: pictureOf("models", id),
    choose: () => studio.edit(recipeOfModel(id), { label: `model ${id}`, change: "restart" }),
  });
  return (studio.catalog?.models ?? []).flatMap((model) => [
    card(model.name, `${model.title}. ${model.summary}`),
    ...model.variants.map((variant) => card(`${model.name}:${variant.name}`, variant.summary || model.title)),
  ]);
}

function makeCard(card: Card): HTMLButtonElement {
  const picture = el("img", { src: card.picture, alt: "", loading: "lazy", decoding: "async", width: 224, height: 224 });
  picture.addEventListener("error", () => picture.classList.add("missing"));
  const node = el("button", { type: "button", class: "card", title: card.summary, "aria-pressed": "false" }, picture, el("span", { class: "card-name" }, card.title));
  node.addEventListener("click", card.choose);
  card.node = node;
  return node;
}

export function coatsPanel(studio: Studio): HTMLElement {
  const groups: Record<string, Card[]> = { recipes: [], models: [] };
  let shown = "recipes";
  const search = el("input", { type: "search", placeholder: "Search coats", "aria-label": "Search coats and models", spellcheck: "false" });
  const grid = el("div", { class: "cards" });
  const none = el("p", { class: "quiet-text", hidden: true }, "Nothing of that name. Try “spots”, “stripes” or “maze”.");
  const about = el("p", { class: "about" });

  const filter = (): void => {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    let count = 0;
    for (const card of groups[shown]!) {
      const text = `${card.id} ${card.summary}`.toLowerCase();
      const fits = words.every((word) => text.includes(word));
      card.node!.hidden = !fits;
      count += fits ? 1 : 0;
    }
    none.hidden = count > 0 || groups[shown]!.length === 0;
  };
  const fill = (): void => {
    grid.replaceChildren(...groups[shown]!.map((card) => card.node ?? makeCard(card)));
    filter();
    mark();
  };
  const mark = (): void => {
    const name = stringValue(topValue(studio.recipe, "name"));
    const model = stringValue(stageValue(studio.recipe, 0, "model"));
    const current = shown === "recipes" ? name : name === model ? model : null;
    for (const card of groups[shown]!) card.node?.setAttribute("aria-pressed", String(card.id === current));
    const summary = stringValue(topValue(studio.recipe, "summary")) ?? groups["models"]!.find((card) => card.id === model)?.summary ?? "";
    about.replaceChildren(el("strong", {}, name ?? "Your coat"), summary ? ` ${summary}` : "");
  };
  const kinds = choice("Kind", [{ value: "recipes", text: "Coats" }, { value: "models", text: "Models" }], "recipes", (kind) => {
    shown = kind;
    search.placeholder = kind === "recipes" ? "Search coats" : "Search models";
    fill();
  });
  search.addEventListener("input", filter);
  studio.on("ready", () => {
    groups["recipes"] = recipeCards(studio);
    groups["models"] = modelCards(studio);
    fill();
  });
  studio.on("recipe", mark);
  return el(
    "div",
    { class: "panel coats" },
    el("div", { class: "panel-top" }, kinds.node, el("div", { class: "search" }, icon("search"), search)),
    el("div", { class: "scroll" }, grid, none),
    about,
  );
}
