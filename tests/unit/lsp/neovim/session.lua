-- What a person would do: open a card, look at the finding, take the repair, rename the element, save.
local said = {}
local function say(text) table.insert(said, text) end
local function finish(code)
  vim.fn.writefile(said, 'said.txt')
  vim.cmd(code .. 'cquit')
end

local ok, why = pcall(function()
  vim.cmd('filetype on')
  vim.cmd('luafile ' .. vim.env.POPUP_EDITORS .. '/neovim.lua')
  vim.cmd('edit card.xml')
  local function wait(what, test)
    if not vim.wait(30000, test, 20) then error('waited in vain for ' .. what) end
  end
  wait('the finding', function() return #vim.diagnostic.get(0) > 0 end)
  for _, one in ipairs(vim.diagnostic.get(0)) do
    say(string.format('%d:%d %s %s', one.lnum, one.col, one.source, one.user_data and one.user_data.lsp and one.user_data.lsp.code or one.code))
  end
  vim.api.nvim_win_set_cursor(0, { 6, 6 })
  local params = vim.lsp.util.make_range_params()
  params.context = { diagnostics = {} }
  local answers = vim.lsp.buf_request_sync(0, 'textDocument/codeAction', params, 30000)
  local client_id, answer = next(answers)
  for _, action in ipairs(answer.result) do say(action.title) end
  vim.lsp.util.apply_workspace_edit(answer.result[1].edit, vim.lsp.get_client_by_id(client_id).offset_encoding)
  wait('no finding', function() return #vim.diagnostic.get(0) == 0 end)
  vim.api.nvim_win_set_cursor(0, { 6, 32 })
  vim.lsp.buf.rename('marquee')
  wait('the new id', function() return vim.api.nvim_buf_get_lines(0, 5, 6, false)[1]:find('marquee') ~= nil end)
  -- The same client formats, and knows the lens.
  vim.api.nvim_buf_set_lines(0, 4, 5, false, { '      <structurelist>   ' })
  local format = vim.lsp.buf.format or function() vim.lsp.buf.formatting_sync(nil, 30000) end
  format({ timeout_ms = 30000 })
  wait('the canonical spelling', function() return vim.api.nvim_buf_get_lines(0, 4, 5, false)[1] == '  <structurelist>' end)
  local lenses = vim.lsp.buf_request_sync(0, 'textDocument/codeLens', { textDocument = vim.lsp.util.make_text_document_params() }, 30000)
  say(lenses[client_id].result[1].command.title)
  vim.cmd('write')
end)
if not ok then say(tostring(why)) end
finish(ok and 0 or 1)
