// Questions to check oneself by: each option becomes a button that tells at once whether it is right, and why. What was
// chosen stays chosen while the page is open, also where a live page sets the question anew. Without scripts the answers
// stand folded below the question.
const dynlabChoices = (() => {
  "use strict";
  const { tr, text } = dynlabWords;
  const chosen = new Map();  // the question's text -> places of the options

  function begin(question) {
    const answer = question.querySelector("details.answer"), reasons = answer?.querySelector("ol");
    const list = [...question.querySelectorAll("ol")].filter((one) => !answer?.contains(one)).pop();
    if (!reasons || !list || question.classList.contains("asked")) return;
    const right = question.dataset.right.split(" ").map(Number), key = list.parentElement.textContent.trim();
    const places = chosen.get(key) ?? chosen.set(key, new Set()).get(key);
    question.classList.add("asked");
    list.setAttribute("aria-label", text(tr("Choose an answer.")));
    [...list.children].forEach((option, i) => {
      const button = document.createElement("button"), verdict = document.createElement("div");
      button.className = "option";
      button.type = "button";
      button.append(...option.childNodes);
      verdict.className = "verdict";
      verdict.setAttribute("aria-live", "polite");
      option.append(button, verdict);
      const tell = () => {
        const told = places.has(i);
        button.setAttribute("aria-pressed", String(told));
        option.classList.toggle("right", told && right.includes(i + 1));
        option.classList.toggle("wrong", told && !right.includes(i + 1));
        verdict.replaceChildren(...(told ? reasons.children[i].cloneNode(true).childNodes : []));
      };
      button.onclick = () => {
        if (!places.delete(i)) places.add(i);
        tell();
      };
      tell();
    });
  }

  function enliven(root) { root.querySelectorAll("div.choice").forEach(begin); }
  return { enliven };
})();
