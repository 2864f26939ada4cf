// SPDX-License-Identifier: Apache-2.0
// Texts and numbers in a language, as markup.
export const escaped = (text) => String(text).replace(/[&<>"']/g, (sign) => `&#${sign.charCodeAt(0)};`);

export class Words {
  // text(key, values): as of page.js.
  constructor(language, text) {
    this.language = language;
    this.plain = text;
  }

  text(key, values) { return escaped(this.plain(key, values)); }

  number(value, digits = 2) {
    return new Intl.NumberFormat(this.language, {minimumFractionDigits: digits, maximumFractionDigits: digits})
        .format(value);
  }

  signed(value, digits = 2) {
    return new Intl.NumberFormat(this.language, {minimumFractionDigits: digits, maximumFractionDigits: digits,
                                                 signDisplay: "exceptZero"}).format(value);
  }
}
