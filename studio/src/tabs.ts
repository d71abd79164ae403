/** Docks of panels with tabs, to be used by keys as the patterns of ARIA have it. */

import { el } from "./dom";

export interface Tab {
  id: string;
  label: string;
  panel: HTMLElement;
}

export interface Dock {
  node: HTMLElement;
  /** Shows the panel of this name; other docks' names are no concern of this one. */
  show(id: string): void;
}

export function dock(side: string, label: string, tabs: Tab[]): Dock {
  const list = el("div", { class: "tabs", role: "tablist", "aria-label": label });
  const panels = el("div", { class: "panels" });
  const buttons = tabs.map(({ id, label: text, panel }) => {
    const one = el("button", { type: "button", role: "tab", id: `tab-${id}`, "aria-controls": `panel-${id}` }, text);
    panel.id = `panel-${id}`;
    panel.setAttribute("role", "tabpanel");
    panel.setAttribute("aria-labelledby", one.id);
    one.addEventListener("click", () => show(id));
    list.append(one);
    panels.append(panel);
    return one;
  });
  const show = (id: string): void => {
    if (!tabs.some((tab) => tab.id === id)) return;
    tabs.forEach((tab, i) => {
      tab.panel.hidden = tab.id !== id;
      buttons[i]!.setAttribute("aria-selected", String(tab.id === id));
      buttons[i]!.tabIndex = tab.id === id ? 0 : -1;
    });
    document.body.dataset["dock"] = side;
    buttons.find((one) => one.id === `tab-${id}`)?.scrollIntoView({ block: "nearest", inline: "nearest" });
  };
  list.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const index = buttons.findIndex((one) => one.tabIndex === 0);
    const next = buttons[(index + step + buttons.length) % buttons.length]!;
    next.click();
    next.focus();
  });
  show(tabs[0]!.id);
  return { node: el("aside", { class: `dock ${side}`, "aria-label": label }, list, panels), show };
}
